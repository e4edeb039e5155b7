// SPDX-License-Identifier: MIT
/* A DC motor that turns to angle 0 and stays there: the controller of dc_motor.toml and, in place of a real motor, a
 * few lines of physics. Any board will do, nothing has to be connected. The serial monitor (115200 baud) shows a line
 * every 3 ms of the motor's time: milliseconds, angle in µrad, voltage in mV.
 *
 * dc_motor.h was made on a PC by
 *
 *     lqgen dc_motor.toml --only h --style unrolled --real float
 *
 * For a motor of your own change dc_motor.toml, run lqgen again, and put in place of run_motor() what reads your
 * encoder and your current sensor and sets your motor driver, from a timer of DC_MOTOR_SAMPLE_TIME. */
#include <TinyLQG.h>

#include "dc_motor.h"

static const float K = 0.0274f;      // N m/A, V s/rad
static const float J = 3.2284e-6f;   // kg m²
static const float b = 3.5077e-6f;   // N m s
static const float R = 4.0f;         // Ω

static const int samples = 60, samples_per_line = 3;

static struct {
  float angle, speed, current;
} motor = {1.0f, 0.0f, 0.0f};

static dc_motor_t controller;

// One sample time of the motor at a constant voltage.
static void run_motor(float voltage) {
  const float T = DC_MOTOR_SAMPLE_TIME;

  motor.current = (voltage - K * motor.speed) / R;
  motor.speed += T * (K * motor.current - b * motor.speed) / J;
  motor.angle += T * motor.speed;
}

static void print_line(int k, float voltage) {
  Serial.print(k);
  Serial.print(' ');
  Serial.print((long)(motor.angle * 1e6f));
  Serial.print(' ');
  Serial.println((long)(voltage * 1e3f));
}

void setup() {
  lqg_status_t status = LQG_OK;
  unsigned long most = 0;

  Serial.begin(115200);
  dc_motor_init(&controller);
  for (int k = 0; k < samples; k++) {
    const float y[DC_MOTOR_NY] = {motor.angle, motor.current};
    float u[DC_MOTOR_NU];

    const unsigned long before = micros();
    status |= dc_motor_step(&controller, y, u);
    const unsigned long taken = micros() - before;
    most = taken > most ? taken : most;

    if (k % samples_per_line == 0)
      print_line(k, u[DC_MOTOR_U_VOLTAGE]);
    run_motor(u[DC_MOTOR_U_VOLTAGE]);
  }
  Serial.print(F("# a sample takes at most "));
  Serial.print(most);
  Serial.print(F(" us; status "));
  Serial.println(status);
  Serial.println(F("end"));
}

void loop() {
}
