/* SPDX-License-Identifier: MIT */
#include "balancer.h"

#include <math.h>

#define SAMPLES(seconds) ((unsigned)((seconds) / BALANCING_ROBOT_SAMPLE_TIME + 0.5f))
#define STILL_FOR SAMPLES(1.0f)
#define LIMITED_FOR SAMPLES(0.5f)
#define BLIND_FOR SAMPLES(0.1f)

enum { LATE_FOR = 5 };

static const float upright = 0.09f;   /* rad, 5°: where it may begin */
static const float fallen = 0.5f;     /* rad, 29°: far more than while it balances */
static const float calm = 0.17f;      /* rad/s, 10 °/s: a hand that holds it, and any gyroscope's offset */
static const float let_go = 0.1f;     /* rad/s, 6 °/s: it tips */
static const float turn_gain = 1.0f;  /* V/rad: how hard it holds its direction; the design knows nothing of it */
static const float turn_limit = 1.0f; /* V: what that may take from a wheel */

void balancer_init(balancer_t *self)
{
    static const balancer_t nothing = {.state = BALANCER_WAITING};

    *self = nothing;
    balancing_robot_init(&self->loop);
    hardware_stop();
}

static int is_finite(float value)
{
    return value - value == 0.0f;
}

static int has_all(const sensors_t *sensors)
{
    return is_finite(sensors->left) && is_finite(sensors->right) && is_finite(sensors->gyro) &&
           is_finite(sensors->tilt);
}

static void stop(balancer_t *self, balancer_reason_t reason)
{
    hardware_stop();
    self->state = BALANCER_WAITING;
    self->reason = reason;
    self->still = 0;
    self->voltage = 0.0f;
}

/* ---- waiting -------------------------------------------------------------------------------------------- */

static void get_ready(balancer_t *self, const sensors_t *sensors)
{
    balancing_robot_init(&self->loop);
    self->gyro_offset = self->gyro_sum / (float)self->still;
    self->zero = 0.5f * (sensors->left + sensors->right);
    self->turn = sensors->right - sensors->left;
    self->limited = self->blind = self->late = self->in_time = 0;
    self->state = BALANCER_READY;
}

/* A second without motion gives the gyroscope's offset, too. NaN is neither upright nor calm. */
static void wait(balancer_t *self, const sensors_t *sensors)
{
    const int may_begin = fabsf(sensors->tilt) < upright && fabsf(sensors->gyro) < calm && has_all(sensors);

    hardware_stop();
    self->gyro_sum = self->still == 0 ? 0.0f : self->gyro_sum;
    self->gyro_sum += may_begin ? sensors->gyro : 0.0f;
    self->still = may_begin ? self->still + 1 : 0;
    if (self->still >= STILL_FOR)
        get_ready(self, sensors);
}

/* ---- ready ---------------------------------------------------------------------------------------------- */

static void measure(const balancer_t *self, const sensors_t *sensors, float y[BALANCING_ROBOT_NY])
{
    y[BALANCING_ROBOT_Y_ENCODER] = 0.5f * (sensors->left + sensors->right) - self->zero;
    y[BALANCING_ROBOT_Y_GYRO] = sensors->gyro - self->gyro_offset;
}

/* The filter runs without voltage, so that it knows where the robot is when it is let go. */
static void watch(balancer_t *self, const sensors_t *sensors)
{
    static const float nothing[BALANCING_ROBOT_NU] = {0.0f};
    float y[BALANCING_ROBOT_NY];

    hardware_stop();
    measure(self, sensors, y);
    balancing_robot_update(&self->loop, y);
    balancing_robot_predict(&self->loop, nothing);
    if (!has_all(sensors))
        stop(self, BALANCER_BLIND);
    else if (fabsf(sensors->tilt) > upright)
        stop(self, BALANCER_NEW);
    else if (fabsf(y[BALANCING_ROBOT_Y_GYRO]) > let_go)
        self->state = BALANCER_BALANCING;
}

/* ---- balancing ------------------------------------------------------------------------------------------ */

static unsigned in_a_row(unsigned count, int again)
{
    return again ? count + 1 : 0;
}

static float within(float value, float limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

static void drive(const balancer_t *self, const sensors_t *sensors, float voltage)
{
    const float turned = sensors->right - sensors->left - self->turn;
    const float correction = is_finite(turned) ? within(0.5f * turn_gain * turned, turn_limit) : 0.0f;

    hardware_drive(voltage + correction, voltage - correction);
}

static void look_for_trouble(balancer_t *self, lqg_status_t status)
{
    self->limited = in_a_row(self->limited, (status & LQG_INPUT_LIMITED) != 0);
    self->blind = in_a_row(self->blind, (status & LQG_OUTPUT_REJECTED) != 0);
    if (fabsf(self->loop.x[BALANCING_ROBOT_X_PITCH]) > fallen)
        stop(self, BALANCER_FALLEN);
    else if (self->limited >= LIMITED_FOR)
        stop(self, BALANCER_LIFTED);
    else if (self->blind >= BLIND_FOR)
        stop(self, BALANCER_BLIND);
}

static void balance(balancer_t *self, const sensors_t *sensors)
{
    float y[BALANCING_ROBOT_NY], u[BALANCING_ROBOT_NU];
    lqg_status_t status;

    measure(self, sensors, y);
    status = balancing_robot_update(&self->loop, y);
    status |= balancing_robot_control(&self->loop, u);
    drive(self, sensors, u[BALANCING_ROBOT_U_VOLTAGE]);

    self->voltage = u[BALANCING_ROBOT_U_VOLTAGE];
    status |= balancing_robot_predict(&self->loop, u);
    look_for_trouble(self, status);
}

/* ---- every sample --------------------------------------------------------------------------------------- */

void balancer_run_sample(balancer_t *self)
{
    hardware_read(&self->sensors);
    if (self->state == BALANCER_BALANCING)
        balance(self, &self->sensors);
    else if (self->state == BALANCER_READY)
        watch(self, &self->sensors);
    else
        wait(self, &self->sensors);
    self->samples++;
    self->in_time++;
}

/* The sample that was late is not one in time. */
void balancer_note_overrun(balancer_t *self)
{
    self->overruns++;
    self->late = self->in_time > 1 ? 1 : self->late + 1;
    self->in_time = 0;
    if (self->state == BALANCER_BALANCING && self->late >= LATE_FOR)
        stop(self, BALANCER_LATE);
}

const char *balancer_text(const balancer_t *self)
{
    static const char *const reasons[] = {"waits to be held upright", "has fallen", "was lifted", "lost a sensor",
                                          "was too late"};

    if (self->state == BALANCER_BALANCING)
        return "balances";
    if (self->state == BALANCER_READY)
        return "is ready, let it go";
    return has_all(&self->sensors) ? reasons[self->reason] : "waits for its sensors";
}
