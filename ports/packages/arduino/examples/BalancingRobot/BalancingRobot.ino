// SPDX-License-Identifier: MIT
/* A robot on two wheels that balances, on an Arduino Uno or Nano.
 *
 * Parts:
 *
 *   Arduino Uno or Nano (ATmega328P, 16 MHz)
 *   MPU-6050 on a breakout board (GY-521)
 *   TB6612FNG motor driver
 *   2 motors with encoders and wheels of 8 cm: those of LEGO Mindstorms NXT, whose constants are in the design
 *   battery of 7.2 V to 8.4 V: two lithium cells or six NiMH cells, with a switch
 *   resistors of 20 kΩ and 10 kΩ
 *
 * Connections: hardware.h. The robot of the design is an NXTway-GS: wheels of 8 cm, a body of 0.6 kg, 14 cm high, with
 * its centre of mass 7.2 cm above the axle. For another robot weigh and measure it, let plant.py print the plant, put
 * that into balancing_robot.toml, and run
 *
 *     lqgen balancing_robot.toml --only h --style unrolled --real float
 *
 * Use: switch on with the robot at rest, in any position, for two seconds: the light is on while the gyroscope's offset
 * is measured. Hold the robot upright: when it has been so for half a second, the light begins to blink fast, the
 * motors start, and it stands by itself. When it falls, when the gyroscope is silent, or when the battery is empty, the
 * motors stop.
 *
 * The first time, before the battery feeds the motors: while it waits, the serial monitor (115200 baud) shows once a
 * second the tilt, what the wheels have turned (all in degrees) and the battery's voltage. The tilt has to be positive
 * forward, and both wheels have to count up when the robot is rolled forward (else exchange that encoder's channels).
 * Then hold it with the wheels in the air: tilted forward they have to run forward (else exchange that motor's
 * wires). */
#include <TinyLQG.h>
#include <Wire.h>

#include "balancing_robot.h"
#include "hardware.h"

enum State { MEASURES_OFFSET, WAITS, BALANCES };

static const int offset_samples = 500;          // 2 s
static const int start_samples = 125;           // 0.5 s upright and still
static const int silent_samples = 25;           // 0.1 s without the gyroscope
static const float still_rate = 0.1f;           // rad/s
static const float upright_pitch = 0.05f;       // rad
static const float fallen_pitch = 0.6f;         // rad
static const float turned_wheel = 30.0f;        // rad, 1.2 m from the start
static const float empty_battery = 6.0f;        // V
static const float straight_gain = 1.0f;        // V per rad between the wheels

static balancing_robot_t controller;
static State state = MEASURES_OFFSET;
static int count = 0;                           // samples that the state has had of what it waits for
static float gyro_sum = 0.0f, gyro_offset = 0.0f;

static void enter(State next) {
  state = next;
  count = 0;
  if (next != BALANCES)
    motors_stop();
  Serial.println(next == MEASURES_OFFSET ? F("measures offset") : next == WAITS ? F("waits") : F("balances"));
}

// The mean of the gyroscope while it is at rest; what moves it begins the measurement anew.
static void measure_offset(const Motion &motion) {
  if (!motion.is_valid || (count > 0 && fabs(motion.pitch_rate - gyro_sum / count) > still_rate)) {
    count = 0;
    gyro_sum = 0.0f;
    return;
  }
  gyro_sum += motion.pitch_rate;
  if (++count == offset_samples) {
    gyro_offset = gyro_sum / offset_samples;
    enter(WAITS);
  }
}

// Begins where the robot is held.
static void start(float pitch) {
  balancing_robot_init(&controller);
  controller.x[BALANCING_ROBOT_X_PITCH] = pitch;
  controller.x[BALANCING_ROBOT_X_WHEEL] = pitch;  // the encoders begin at 0 = wheel − pitch
  encoders_begin();
  motors_start();
  enter(BALANCES);
}

static void print_sensors(const Motion &motion) {
  const float values[] = {motion.tilt * (180 / PI), left_wheel() * (180 / PI), right_wheel() * (180 / PI),
                          battery_voltage()};

  for (const float value : values) {
    Serial.print(value, 1);
    Serial.print(' ');
  }
  Serial.println(motion.is_valid ? F("") : F("no answer from the MPU-6050"));
}

static void wait_for_upright(const Motion &motion) {
  const bool is_upright = motion.is_valid && fabs(motion.tilt) < upright_pitch &&
                          fabs(motion.pitch_rate - gyro_offset) < still_rate && battery_voltage() > empty_battery;

  static unsigned char samples = 0;
  if (++samples == 250) {
    samples = 0;
    print_sensors(motion);
  }
  count = is_upright ? count + 1 : 0;
  if (count >= start_samples)
    start(motion.tilt);
}

static void balance(const Motion &motion) {
  float y[BALANCING_ROBOT_NY], u[BALANCING_ROBOT_NU];
  const float left = left_wheel(), right = right_wheel();

  y[BALANCING_ROBOT_Y_ENCODER] = 0.5f * (left + right);
  y[BALANCING_ROBOT_Y_GYRO] = motion.is_valid ? motion.pitch_rate - gyro_offset : NAN;  // NaN is left out
  balancing_robot_update(&controller, y);
  balancing_robot_control(&controller, u);

  // Both motors get u; a little of it goes from the wheel that is ahead to the other.
  u[BALANCING_ROBOT_U_VOLTAGE] = motors_set(u[BALANCING_ROBOT_U_VOLTAGE], straight_gain * (left - right));
  balancing_robot_predict(&controller, u);

  count = motion.is_valid ? 0 : count + 1;
  if (!(fabs(controller.x[BALANCING_ROBOT_X_PITCH]) < fallen_pitch) ||
      fabs(y[BALANCING_ROBOT_Y_ENCODER]) > turned_wheel ||
      count > silent_samples || battery_voltage() < empty_battery)
    enter(WAITS);
}

static void show_state() {
  static unsigned char samples = 0;
  const bool blinks = samples++ & 16;

  digitalWrite(LED_BUILTIN, state == MEASURES_OFFSET || (state == BALANCES && blinks) ? HIGH : LOW);
}

void setup() {
  Serial.begin(115200);
  pinMode(LED_BUILTIN, OUTPUT);
  motors_begin();
  encoders_begin();
  motion_begin();
  enter(MEASURES_OFFSET);
  clock_begin(BALANCING_ROBOT_SAMPLE_TIME);
}

void loop() {
  static bool was_late = false;

  if (!clock_ticked(&was_late))
    return;
  if (was_late)
    Serial.println(F("late"));
  battery_measure();

  const Motion motion = motion_read(state != BALANCES);
  switch (state) {
  case MEASURES_OFFSET: measure_offset(motion); break;
  case WAITS: wait_for_upright(motion); break;
  case BALANCES: balance(motion); break;
  }
  show_state();
}
