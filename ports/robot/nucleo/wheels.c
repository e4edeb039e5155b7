/* SPDX-License-Identifier: MIT */
#include "wheels.h"

#include "stm32f401.h"

/* What differs from robot to robot. */
static const float battery = 8.0f;          /* V, under load */
static const float counts_of_turn = 720.0f; /* of LEGO's NXT motor: 180 periods of both channels, each edge counted */
static const float left_sign = 1.0f;
static const float right_sign = -1.0f; /* the right motor is mounted the other way round */

enum { PWM_STEPS = 800 };                         /* 16 MHz / 800 = 20 kHz: not to be heard */
enum { AIN1 = 10, AIN2 = 4, BIN1 = 5, BIN2 = 3 }; /* of port B */
enum { ENCODER_A1 = 0, ENCODER_A2 = 1, ENCODER_B1 = 6, ENCODER_B2 = 7, PWMA = 8, PWMB = 9, STBY = 10 }; /* of port A */
enum { TIM1_TIM2_FUNCTION = 1, TIM3_FUNCTION = 2, PULL_UP = 1 };

/* ---- encoders ------------------------------------------------------------------------------------------- */

static int32_t left_counts, right_counts;

static void start_encoder(timer_t *timer)
{
    timer->ccmr1 = 0x3131; /* both inputs, steady for 8 clocks */
    timer->smcr = 3;       /* counts every edge of both */
    timer->arr = 0xFFFF;
    timer->cnt = 0;
    timer->cr1 = 1;
}

static void pull_up(unsigned pin)
{
    GPIOA->pupdr |= (uint32_t)PULL_UP << 2 * pin;
}

static void start_encoders(void)
{
    static const uint8_t pins[] = {ENCODER_A1, ENCODER_A2, ENCODER_B1, ENCODER_B2};

    for (unsigned i = 0; i < sizeof pins; i++) {
        pull_up(pins[i]);
        gpio_set_mode(GPIOA, pins[i], GPIO_ALTERNATE, i < 2 ? TIM1_TIM2_FUNCTION : TIM3_FUNCTION);
    }
    start_encoder(TIM2);
    start_encoder(TIM3);
}

/* What a counter of 16 bits has moved since `counts`, whichever way. */
static int32_t moved(const timer_t *timer, int32_t counts)
{
    return (int16_t)(uint16_t)((timer->cnt - (uint32_t)counts) & 0xFFFF);
}

void wheels_read(float *left, float *right)
{
    const float angle_of_count = 2.0f * 3.14159265f / counts_of_turn;

    left_counts += moved(TIM2, left_counts);
    right_counts += moved(TIM3, right_counts);
    *left = left_sign * angle_of_count * (float)left_counts;
    *right = right_sign * angle_of_count * (float)right_counts;
}

/* ---- motors --------------------------------------------------------------------------------------------- */

static void start_pwm(void)
{
    gpio_set_mode(GPIOA, PWMA, GPIO_ALTERNATE, TIM1_TIM2_FUNCTION);
    gpio_set_mode(GPIOA, PWMB, GPIO_ALTERNATE, TIM1_TIM2_FUNCTION);
    TIM1->arr = PWM_STEPS - 1;
    TIM1->ccmr1 = 0x6868;  /* both channels: PWM mode 1, new values at the end of a period */
    TIM1->ccer = 0x0011;   /* both outputs on */
    TIM1->bdtr = 1u << 15; /* main output enable */
    TIM1->cr1 = 1;
}

static void start_motors(void)
{
    static const uint8_t outputs[] = {AIN1, AIN2, BIN1, BIN2};

    for (unsigned i = 0; i < sizeof outputs; i++)
        gpio_set_mode(GPIOB, outputs[i], GPIO_OUTPUT, 0);
    wheels_release();
    gpio_set_mode(GPIOA, STBY, GPIO_OUTPUT, 0);
    start_pwm();
}

void wheels_start(void)
{
    RCC->ahb1enr |= RCC_GPIOA | RCC_GPIOB;
    RCC->apb1enr |= RCC_TIM2 | RCC_TIM3;
    RCC->apb2enr |= RCC_TIM1;
    start_motors();
    start_encoders();
}

/* The direction goes to two pins, the size to the PWM; the controller has kept it within the battery's. */
static uint32_t drive_motor(float voltage, unsigned in1, unsigned in2)
{
    const float size = (voltage < 0.0f ? -voltage : voltage) / battery;

    gpio_write(GPIOB, in1, voltage > 0.0f);
    gpio_write(GPIOB, in2, voltage < 0.0f);
    return (uint32_t)((float)PWM_STEPS * (size < 1.0f ? size : 1.0f));
}

void wheels_drive(float left, float right)
{
    TIM1->ccr1 = drive_motor(left_sign * left, AIN1, AIN2);
    TIM1->ccr2 = drive_motor(right_sign * right, BIN1, BIN2);
    gpio_write(GPIOA, STBY, 1);
}

void wheels_release(void)
{
    gpio_write(GPIOA, STBY, 0);
    TIM1->ccr1 = 0;
    TIM1->ccr2 = 0;
}
