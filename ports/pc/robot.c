/* SPDX-License-Identifier: MIT */
#include "robot.h"

#include <math.h>

/* NXTway-GS: Y. Yamamoto, "NXTway-GS Model-Based Design", Cybernet Systems, revision 1.4, 2009, chapter 3, equations of
 * motion in the vertical plane; α and β are the motor's, of both wheels. */
static const double gravity = 9.81;          /* m/s² */
static const double wheel_mass = 0.03;       /* kg, m */
static const double wheel_radius = 0.04;     /* m, R */
static const double body_mass = 0.6;         /* kg, M */
static const double body_center = 0.072;     /* m above the axle, L */
static const double motor_inertia = 1e-5;    /* kg m², Jm */
static const double motor_resistance = 6.69; /* Ω, Rm */
static const double motor_back_emf = 0.468;  /* V s/rad, Kb */
static const double motor_torque = 0.317;    /* N m/A, Kt */
static const double motor_friction = 0.0022; /* N m s/rad, fm */

/* (2m + M)R² + 2Jw + 2Jm   M L R cos ψ − 2Jm    [θ̈]   2α v − 2β (θ̇ − ψ̇) + M L R ψ̇² sin ψ
 * M L R cos ψ − 2Jm        M L² + Jψ + 2Jm      [ψ̈] = −2α v + 2β (θ̇ − ψ̇) + M g L sin ψ + push */
static robot_t derivative(const robot_t *robot, double voltage, double push)
{
    const double wheel_inertia = wheel_mass * wheel_radius * wheel_radius / 2.0;
    const double body_inertia = body_mass * body_center * body_center / 3.0;
    const double alpha = motor_torque / motor_resistance;
    const double beta = motor_torque * motor_back_emf / motor_resistance + motor_friction;
    const double arm = body_mass * body_center * wheel_radius;

    const double e11 =
        (2.0 * wheel_mass + body_mass) * wheel_radius * wheel_radius + 2.0 * wheel_inertia + 2.0 * motor_inertia;
    const double e12 = arm * cos(robot->pitch) - 2.0 * motor_inertia;
    const double e22 = body_mass * body_center * body_center + body_inertia + 2.0 * motor_inertia;
    const double slip = robot->wheel_rate - robot->pitch_rate;
    const double motor = 2.0 * alpha * voltage - 2.0 * beta * slip;
    const double f1 = motor + arm * robot->pitch_rate * robot->pitch_rate * sin(robot->pitch);
    const double f2 = -motor + body_mass * gravity * body_center * sin(robot->pitch) + push;
    const double determinant = e11 * e22 - e12 * e12;
    const robot_t rate = {robot->wheel_rate, robot->pitch_rate, (e22 * f1 - e12 * f2) / determinant,
                          (e11 * f2 - e12 * f1) / determinant};
    return rate;
}

static robot_t ahead(const robot_t *robot, const robot_t *rate, double seconds)
{
    const robot_t next = {robot->wheel + seconds * rate->wheel, robot->pitch + seconds * rate->pitch,
                          robot->wheel_rate + seconds * rate->wheel_rate,
                          robot->pitch_rate + seconds * rate->pitch_rate};
    return next;
}

/* Runge and Kutta's fourth-order step. */
static void runge_kutta(robot_t *robot, double voltage, double push, double h)
{
    const robot_t k1 = derivative(robot, voltage, push);
    const robot_t at2 = ahead(robot, &k1, h / 2.0);
    const robot_t k2 = derivative(&at2, voltage, push);
    const robot_t at3 = ahead(robot, &k2, h / 2.0);
    const robot_t k3 = derivative(&at3, voltage, push);
    const robot_t at4 = ahead(robot, &k3, h);
    const robot_t k4 = derivative(&at4, voltage, push);

    *robot = ahead(robot, &k1, h / 6.0);
    *robot = ahead(robot, &k2, h / 3.0);
    *robot = ahead(robot, &k3, h / 3.0);
    *robot = ahead(robot, &k4, h / 6.0);
}

void robot_run(robot_t *robot, double voltage, double push, double seconds)
{
    enum { STEPS = 8 }; /* the fastest mode, of the motor, takes 4 ms */

    for (int i = 0; i < STEPS; i++)
        runge_kutta(robot, voltage, push, seconds / (double)STEPS);
}
