/* SPDX-License-Identifier: MIT */
/* The robot's parts and their connections to an Uno or Nano.
 *
 *   pin   connected to
 *   2     left encoder, channel A            NXT motor: yellow; its power is 5 V on green, ground on red
 *   4     left encoder, channel B            blue
 *   3     right encoder, channel A
 *   5     right encoder, channel B
 *   6, 7  TB6612FNG AIN1, AIN2               left motor on AO1, AO2; NXT motor: white, black
 *   9     TB6612FNG PWMA
 *   10    TB6612FNG PWMB
 *   11    TB6612FNG STBY
 *   A0    battery through 20 kΩ, and 10 kΩ to ground
 *   A1, A2 TB6612FNG BIN1, BIN2              right motor on BO1, BO2
 *   A4    MPU-6050 SDA
 *   A5    MPU-6050 SCL
 *   5V    MPU-6050 VCC, TB6612FNG VCC, encoders
 *   VIN   battery, and TB6612FNG VM
 *   GND   ground of all of them
 *
 * The MPU-6050 lies flat when the robot is upright, its X arrow to the front, its Y arrow to the left. Forward is the
 * way in which both wheels count up: where one counts down, exchange its channels A and B.
 *
 * Timer 1 makes the PWM of pins 9 and 10, timer 2 is the clock of the loop: no tone(), no Servo. */
#ifndef HARDWARE_H
#define HARDWARE_H

#include <Arduino.h>
#include <Wire.h>
#include <util/atomic.h>

#if !defined __AVR_ATmega328P__ || F_CPU != 16000000L
#error "hardware.h is written for an Uno or Nano: ATmega328P at 16 MHz."
#endif

// ------------------------------------------------------------------------------------------------------- clock

static volatile unsigned char clock_ticks;

ISR(TIMER2_COMPA_vect) {
  clock_ticks++;
}

static void clock_begin(float period) {
  TCCR2A = _BV(WGM21);                                      // clear on compare
  TCCR2B = _BV(CS22) | _BV(CS21);                           // clock/256: 16 µs
  OCR2A = (unsigned char)(period * (F_CPU / 256.0f) - 0.5f);
  TCNT2 = 0;
  TIMSK2 = _BV(OCIE2A);
}

// True once in a period; late: a period went by unused.
static bool clock_ticked(bool *late) {
  unsigned char ticks;

  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    ticks = clock_ticks;
    clock_ticks = 0;
  }
  *late = ticks > 1;
  return ticks > 0;
}

// ----------------------------------------------------------------------------------------------------- battery

static float battery_volts = 0.0f;

// 5 V are 1023 steps, behind the divider by three; the mean of the last 16 samples or so, from the first one on.
static void battery_measure() {
  const float volts = (3 * 5.0f / 1023) * analogRead(A0);

  battery_volts += (battery_volts > 0 ? 1.0f / 16 : 1.0f) * (volts - battery_volts);
}

static float battery_voltage() {
  return battery_volts;
}

// ------------------------------------------------------------------------------------------------------ motors

static const unsigned pwm_top = 400;  // 16 MHz/2/400: 20 kHz

static void motors_stop() {
  digitalWrite(11, LOW);
  OCR1A = OCR1B = 0;
}

static void motors_start() {
  OCR1A = OCR1B = 0;
  digitalWrite(11, HIGH);
}

static void motors_begin() {
  const unsigned char outputs[] = {6, 7, 9, 10, 11, A1, A2};

  for (unsigned i = 0; i < sizeof outputs; i++)
    pinMode(outputs[i], OUTPUT);
  TCCR1A = _BV(COM1A1) | _BV(COM1B1) | _BV(WGM11);  // phase-correct PWM up to ICR1
  TCCR1B = _BV(WGM13) | _BV(CS10);
  ICR1 = pwm_top;
  motors_stop();
}

// The share of the battery's voltage that is as near to the wanted one as can be.
static float motor_duty(float voltage) {
  const float duty = voltage / battery_volts;

  return duty > 1 ? 1.0f : duty < -1 ? -1.0f : duty;
}

static unsigned motor_set(float duty, unsigned char forward, unsigned char backward) {
  digitalWrite(forward, duty > 0 ? HIGH : LOW);
  digitalWrite(backward, duty < 0 ? HIGH : LOW);
  return (unsigned)(fabs(duty) * pwm_top);
}

// Voltages of left and right motor: common − difference, common + difference. Returns the common one that was applied.
static float motors_set(float common, float difference) {
  const float left = motor_duty(common - difference), right = motor_duty(common + difference);

  OCR1A = motor_set(left, 6, 7);
  OCR1B = motor_set(right, A1, A2);
  return 0.5f * (left + right) * battery_volts;
}

// ---------------------------------------------------------------------------------------------------- encoders

// 360 edges of channel A in a turn; the other channel tells the direction.
static const float rad_per_count = 3.14159265f / 180;
static volatile long left_count, right_count;

static void count_left() {
  left_count += digitalRead(2) != digitalRead(4) ? 1 : -1;
}

static void count_right() {
  right_count += digitalRead(3) != digitalRead(5) ? 1 : -1;
}

// From here on the wheels' angles against the body count from 0.
static void encoders_begin() {
  const unsigned char inputs[] = {2, 3, 4, 5};

  for (unsigned i = 0; i < sizeof inputs; i++)
    pinMode(inputs[i], INPUT_PULLUP);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    left_count = right_count = 0;
  }
  attachInterrupt(digitalPinToInterrupt(2), count_left, CHANGE);
  attachInterrupt(digitalPinToInterrupt(3), count_right, CHANGE);
}

static float wheel(const volatile long *count) {
  long counted;

  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    counted = *count;
  }
  return counted * rad_per_count;
}

static float left_wheel() {
  return wheel(&left_count);
}

static float right_wheel() {
  return wheel(&right_count);
}

// ---------------------------------------------------------------------------------------------------- MPU-6050

// InvenSense, "MPU-6000 and MPU-6050 Register Map and Descriptions", revision 4.2.
static const unsigned char mpu = 0x68;
enum {
  CONFIG = 0x1A,
  GYRO_CONFIG = 0x1B,
  ACCEL_CONFIG = 0x1C,
  ACCEL_XOUT_H = 0x3B,
  GYRO_YOUT_H = 0x45,
  PWR_MGMT_1 = 0x6B
};

struct Motion {
  bool is_valid;
  float pitch_rate;  // rad/s, forward
  float tilt;        // rad, forward, of the accelerometer: right when the robot is at rest; 0 when it was not asked for
};

static bool mpu_write(unsigned char address, unsigned char value) {
  Wire.beginTransmission(mpu);
  Wire.write(address);
  Wire.write(value);
  return Wire.endTransmission() == 0;
}

// `count` words from `address` on; false: no answer.
static bool mpu_read(unsigned char address, int words[], unsigned char count) {
  Wire.beginTransmission(mpu);
  Wire.write(address);
  if (Wire.endTransmission(false) != 0 || Wire.requestFrom(mpu, (unsigned char)(2 * count)) != 2 * count)
    return false;
  for (unsigned char i = 0; i < count; i++) {
    const unsigned char high = Wire.read();

    words[i] = (int)((unsigned)high << 8 | (unsigned char)Wire.read());
  }
  return true;
}

static void motion_begin() {
  Wire.begin();
  Wire.setClock(400000);
  Wire.setWireTimeout(2000, true);  // µs: a bus that hangs costs a sample, not the robot
  mpu_write(PWR_MGMT_1, 0x01);    // awake, clock of a gyroscope
  mpu_write(CONFIG, 0x00);        // 256 Hz of bandwidth: 1 ms of delay
  mpu_write(GYRO_CONFIG, 0x08);   // ±500 °/s
  mpu_write(ACCEL_CONFIG, 0x00);  // ±2 g
}

static Motion motion_read(bool with_tilt) {
  const float rad_per_s = 3.14159265f / 180 / 65.5f;
  Motion motion = {false, 0.0f, 0.0f};
  int acceleration[3] = {0, 0, 1}, rate;

  motion.is_valid = mpu_read(GYRO_YOUT_H, &rate, 1);
  if (with_tilt)
    motion.is_valid = mpu_read(ACCEL_XOUT_H, acceleration, 3) && motion.is_valid;
  if (motion.is_valid) {
    motion.pitch_rate = rad_per_s * rate;
    motion.tilt = atan2(-(float)acceleration[0], (float)acceleration[2]);
  }
  return motion;
}

#endif
