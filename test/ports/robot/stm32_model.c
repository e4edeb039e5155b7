/* SPDX-License-Identifier: MIT */
#include "stm32_model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double clock_frequency = 16e6; /* Hz */

world_t world;
unsigned stm32_complaints;

static void complain(int is_wrong, const char *text)
{
    if (is_wrong && stm32_complaints++ < 20)
        printf("complaint: %s\n", text);
}

/* ---- what is only kept ---------------------------------------------------------------------------------- */

enum { PERIPHERALS = 0x30000 / 4 };
static uint32_t kept[PERIPHERALS];

static uint32_t *at(uint32_t address)
{
    return &kept[(address - 0x40000000u) / 4 % PERIPHERALS];
}

enum { RCC_AHB1ENR = 0x40023830, RCC_APB1ENR = 0x40023840, RCC_APB2ENR = 0x40023844 };
enum { GPIO_A = 0x40020000, GPIO_B = 0x40020400, MODER = 0, OTYPER = 4, PUPDR = 12, ODR = 20, BSRR = 24, AFRL = 32 };
enum { TIM1 = 0x40010000, TIM2 = 0x40000000, TIM3 = 0x40000400 };
enum { CR1 = 0, SMCR = 8, CCMR1 = 24, CCER = 32, CNT = 36, PSC = 40, ARR = 44, CCR_1 = 52, CCR_2 = 56, BDTR = 68 };

/* Which bit of which register switches the clock of a kilobyte on. */
static const struct {
    uint32_t peripheral, enable;
    unsigned bit;
} clocks[] = {{GPIO_A, RCC_AHB1ENR, 0},     {GPIO_B, RCC_AHB1ENR, 1}, {TIM2, RCC_APB1ENR, 0},
              {TIM3, RCC_APB1ENR, 1},       {TIM1, RCC_APB2ENR, 0},   {0x40004400, RCC_APB1ENR, 17},
              {0x40005400, RCC_APB1ENR, 21}};

static int has_clock(uint32_t address)
{
    for (unsigned i = 0; i < sizeof clocks / sizeof clocks[0]; i++)
        if ((address & ~0x3FFu) == clocks[i].peripheral)
            return (*at(clocks[i].enable) >> clocks[i].bit & 1) != 0;
    return (address & ~0x3FFu) == 0x40023800 || (address & ~0x3FFu) == 0x40003000; /* RCC, IWDG: always */
}

/* ---- pins ----------------------------------------------------------------------------------------------- */

static unsigned mode_of(uint32_t port, unsigned pin)
{
    return *at(port + MODER) >> 2 * pin & 3;
}

static int has_function(uint32_t port, unsigned pin, unsigned function)
{
    return mode_of(port, pin) == 2 && (*at(port + AFRL + pin / 8 * 4) >> 4 * (pin % 8) & 0xF) == function;
}

static int is_high(uint32_t port, unsigned pin)
{
    return mode_of(port, pin) == 1 && (*at(port + ODR) >> pin & 1);
}

static void set_pins(uint32_t port, uint32_t value)
{
    *at(port + ODR) = (*at(port + ODR) & ~(value >> 16)) | (value & 0xFFFF);
}

/* ---- motors and encoders -------------------------------------------------------------------------------- */

static double motor(unsigned in1, unsigned in2, uint32_t compare)
{
    const int direction = is_high(GPIO_B, in1) - is_high(GPIO_B, in2);

    return 8.0 * direction * (double)*at(TIM1 + compare) / (double)(*at(TIM1 + ARR) + 1);
}

/* The right motor is mounted the other way round. */
void stm32_motors(double *left, double *right)
{
    const int runs = (*at(TIM1 + CR1) & 1) && (*at(TIM1 + BDTR) >> 15 & 1) && (*at(TIM1 + CCER) & 0x11) == 0x11 &&
                     (*at(TIM1 + CCMR1) & 0x7070) == 0x6060 && has_function(GPIO_A, 8, 1) && has_function(GPIO_A, 9, 1);
    const int has_current = is_high(GPIO_A, 10);

    complain(has_current && !runs, "the motors have current, but no PWM");
    complain(runs && *at(TIM1 + ARR) + 1 != 16000000 / 20000, "the PWM has not 20 kHz");
    *left = runs && has_current ? motor(10, 4, CCR_1) : 0.0;
    *right = runs && has_current ? -motor(5, 3, CCR_2) : 0.0;
}

static uint32_t encoder(uint32_t timer, double angle, unsigned pin, unsigned function)
{
    const int counts = *at(timer + SMCR) == 3 && (*at(timer + CCMR1) & 0x0303) == 0x0101 && (*at(timer + CR1) & 1) &&
                       has_function(GPIO_A, pin, function) && has_function(GPIO_A, pin + 1, function);

    complain(!counts, "an encoder is read that does not count");
    return (uint32_t)(int32_t)floor(angle / (2.0 * 3.14159265358979) * 720.0) & *at(timer + ARR);
}

/* ---- the MPU-6050 --------------------------------------------------------------------------------------- */

static uint8_t sensor[128] = {[0x6B] = 0x40, [0x75] = 0x68};

static void put_number(unsigned index, double value)
{
    const int number = (int)fmax(-32768.0, fmin(32767.0, floor(value + 0.5)));

    sensor[index] = (uint8_t)(number >> 8 & 0xFF);
    sensor[index + 1] = (uint8_t)(number & 0xFF);
}

static void measure(void)
{
    const double awake = sensor[0x6B] & 0x40 ? 0.0 : 1.0;
    const double g = 16384.0 / (1 << (sensor[0x1C] >> 3 & 3));
    const double degree = 131.0 / (1 << (sensor[0x1B] >> 3 & 3));

    put_number(0x3B, -awake * g * sin(world.pitch));
    put_number(0x3F, awake * g * cos(world.pitch));
    put_number(0x45, awake * degree * 180.0 / 3.14159265358979 * world.pitch_rate);
}

/* ---- I²C, a master -------------------------------------------------------------------------------------- */

enum { I2C = 0x40005400 };
enum { START = 1 << 8, STOP = 1 << 9, ACK = 1 << 10, RESET = 1 << 15 }; /* cr1 */
enum {
    SB = 1 << 0,
    ADDR = 1 << 1,
    BTF = 1 << 2,
    RXNE = 1 << 6,
    TXE = 1 << 7,
    AF = 1 << 10,
    LOOKS_OF_A_BYTE = 3
}; /* sr1 */

static struct {
    uint32_t control, frequency, divider, rise, state;
    enum { IDLE, ADDRESSED, SENDS, RECEIVES } phase;
    int looks;         /* of the program, until what is going on has happened */
    int reads_address; /* the state has been looked at after ADDR */
    int wants_to_receive;
    unsigned sent;   /* bytes since the address */
    uint8_t pointer; /* the sensor's */
    uint8_t data, shift;
    int has_data, has_shift, is_over; /* over: a byte was not acknowledged */
    int is_taken;                     /* between start and stop */
    double seconds;
} bus;

static void take_time(double bits)
{
    bus.seconds += bits * 3.0 * (double)(bus.divider & 0xFFF) / clock_frequency;
    bus.looks = LOOKS_OF_A_BYTE;
}

static void check_set_up(void)
{
    complain((bus.control & 1) == 0, "a start without PE");
    complain(bus.frequency != 16, "I2C_CR2 is not the bus clock in MHz");
    complain((bus.divider >> 15 & 1) == 0 || clock_frequency / (3.0 * (bus.divider & 0xFFF)) > 400e3,
             "SCL is not at most 400 kHz");
    complain(bus.rise != 5, "I2C_TRISE is not that of 300 ns"); /* 300 ns · 16 MHz, rounded down, and 1 */
    complain(!has_function(GPIO_B, 8, 4) || !has_function(GPIO_B, 9, 4), "SCL, SDA are not at the pins");
    complain((*at(GPIO_B + OTYPER) & 0x300) != 0x300, "SCL, SDA are not open drain");
}

static void write_control(uint32_t value)
{
    complain((bus.control & (START | STOP)) != 0 && !(value & RESET),
             "I2C_CR1 is written while a start or stop is on its way");
    if (value & RESET) {
        const double seconds = bus.seconds;

        memset(&bus, 0, sizeof bus);
        bus.seconds = seconds;
    }
    bus.control = value & ~(uint32_t)RESET;
    if (value & START) {
        check_set_up();
        bus.is_taken = 1;
        complain(bus.phase == RECEIVES && !bus.is_over, "a start while the sensor holds the bus");
        take_time(1);
    }
    if (value & STOP) {
        complain(bus.phase == RECEIVES && !bus.is_over, "a stop while the sensor holds the bus");
        bus.looks = LOOKS_OF_A_BYTE;
        bus.is_taken = 0;
    }
}

/* A byte comes while there is room for it; the one that is not acknowledged is the last. */
static void receive(void)
{
    if (bus.phase != RECEIVES || bus.is_over || bus.has_shift)
        return;
    if (bus.pointer == 0x3B)
        measure();
    bus.shift = sensor[bus.pointer++ & 0x7F];
    bus.has_shift = 1;
    bus.is_over = !(bus.control & ACK);
    take_time(9);
}

static void move_on(void)
{
    if (bus.has_shift && !bus.has_data) {
        bus.data = bus.shift;
        bus.has_data = 1;
        bus.has_shift = 0;
        receive();
    }
    bus.state =
        (bus.state & ~(uint32_t)(RXNE | BTF)) | (bus.has_data ? RXNE : 0) | (bus.has_data && bus.has_shift ? BTF : 0);
    if (bus.phase == SENDS)
        bus.state |= TXE | (bus.sent > 0 ? BTF : 0);
}

/* Time passes while the program looks. */
static void pass(void)
{
    if (bus.looks > 0 && --bus.looks > 0)
        return;
    if (bus.control & START) {
        bus.control &= ~(uint32_t)START;
        bus.state = SB;
        bus.phase = IDLE;
        bus.has_data = bus.has_shift = bus.is_over = 0;
    } else if (bus.control & STOP) {
        bus.control &= ~(uint32_t)STOP;
        bus.phase = bus.has_data ? bus.phase : IDLE;
        bus.state &= RXNE;
    } else if (bus.phase == ADDRESSED && !(bus.state & AF)) {
        bus.state |= ADDR;
    } else {
        move_on();
    }
}

static void write_data(uint32_t value)
{
    if (bus.state & SB) {
        complain((value & 0xFE) != 0xD0, "another address than the sensor's");
        bus.state = world.sensor_is_dead ? AF : 0;
        bus.phase = ADDRESSED;
        bus.wants_to_receive = value & 1;
        bus.sent = 0;
    } else {
        complain(bus.phase != SENDS, "a byte is sent that nobody waits for");
        if (bus.sent++ == 0)
            bus.pointer = (uint8_t)value;
        else
            sensor[bus.pointer++ & 0x7F] = (uint8_t)value;
        bus.state &= ~(uint32_t)(TXE | BTF);
    }
    take_time(9);
}

static uint32_t read_data(void)
{
    const uint8_t data = bus.data;

    complain(!bus.has_data, "a byte is read that has not come");
    bus.has_data = 0;
    bus.looks = 0;
    if (bus.has_shift)
        move_on();
    else
        bus.state &= ~(uint32_t)(RXNE | BTF);
    return data;
}

/* Reading it after the state ends the address. */
static uint32_t read_second_state(void)
{
    if (bus.phase == ADDRESSED && bus.state & ADDR) {
        complain(!bus.reads_address, "I2C_SR2 is read without I2C_SR1 before");
        bus.state &= ~(uint32_t)ADDR;
        bus.phase = bus.wants_to_receive ? RECEIVES : SENDS;
        bus.looks = LOOKS_OF_A_BYTE;
        receive();
    }
    return 0;
}

static uint32_t read_bus(uint32_t offset)
{
    switch (offset) {
        case 0x00:
            pass();
            return bus.control;
        case 0x10:
            return read_data();
        case 0x14:
            pass();
            bus.reads_address = (bus.state & ADDR) != 0;
            return bus.state;
        case 0x18:
            return read_second_state();
        default:
            return 0;
    }
}

static void write_bus(uint32_t offset, uint32_t value)
{
    complain((offset == 0x1C || offset == 0x20) && (bus.control & 1), "I2C_CCR, I2C_TRISE are written while PE is set");
    switch (offset) {
        case 0x00:
            write_control(value);
            break;
        case 0x04:
            bus.frequency = value & 0x3F;
            break;
        case 0x10:
            write_data(value);
            break;
        case 0x1C:
            bus.divider = value;
            break;
        case 0x20:
            bus.rise = value;
            break;
        default:
            complain(1, "a register of I²C that the model does not have");
    }
}

/* ---- watchdog, serial port, core ------------------------------------------------------------------------ */

static unsigned fed;
static int watchdog_runs, watchdog_is_open;
static char serial[4096];
static size_t serial_count;
static uint32_t tick_reload, tick_control;

static void write_watchdog(uint32_t offset, uint32_t value)
{
    complain(offset != 0 && !watchdog_is_open, "the watchdog is set without its key");
    if (offset == 0) {
        watchdog_runs |= value == 0xCCCC;
        watchdog_is_open = value == 0x5555;
        fed += value == 0xAAAA;
    }
}

static void write_serial(uint32_t offset, uint32_t value)
{
    if (offset != 4)
        return;
    complain(!has_function(GPIO_A, 2, 7), "TX is not at its pin");
    complain((*at(0x4000440C) & 0x2008) != 0x2008, "the serial port is not on");
    complain(fabs(clock_frequency / (double)*at(0x40004408) / 115200.0 - 1.0) > 0.01,
             "the baud rate is more than 1 % off");
    if (serial_count < sizeof serial - 1)
        serial[serial_count++] = (char)value;
}

const char *stm32_serial(void)
{
    serial[serial_count] = '\0';
    serial_count = 0;
    return serial;
}

double stm32_sample_time(void)
{
    return tick_control == 7 ? (double)(tick_reload + 1) / clock_frequency : 0.0;
}

double stm32_watchdog_time(void)
{
    return watchdog_runs ? (double)((4u << (*at(0x40003004) & 7)) * (*at(0x40003008) + 1)) / 32000.0 : 0.0;
}

stm32_sample_t stm32_begin_sample(void)
{
    const stm32_sample_t last = {fed, bus.seconds};

    complain(bus.is_taken && !world.sensor_is_dead, "the bus is not released after a sample");
    fed = 0;
    bus.seconds = 0.0;
    return last;
}

/* ---- the address space ---------------------------------------------------------------------------------- */

uint32_t stm32_read(uint32_t address)
{
    if (address >= 0xE0000000u)
        return 0;
    complain(!has_clock(address), "a peripheral without clock is read");
    if ((address & ~0x3FFu) == I2C)
        return read_bus(address & 0x3FF);
    if (address == TIM2 + CNT)
        return encoder(TIM2, world.left, 0, 1);
    if (address == TIM3 + CNT)
        return encoder(TIM3, -world.right, 6, 2);
    if (address == 0x40004400)
        return 1 << 7; /* ready to send */
    return *at(address);
}

void stm32_write(uint32_t address, uint32_t value)
{
    if (address == 0xE000E014)
        tick_reload = value;
    if (address == 0xE000E010)
        tick_control = value;
    if (address >= 0xE0000000u)
        return;
    complain(!has_clock(address), "a peripheral without clock is written");
    *at(address) = value;
    if ((address & ~0x3FFu) == I2C)
        write_bus(address & 0x3FF, value);
    if (address == GPIO_A + BSRR || address == GPIO_B + BSRR)
        set_pins(address - BSRR, value);
    if ((address & ~0x3FFu) == 0x40003000)
        write_watchdog(address & 0x3FF, value);
    if ((address & ~0x3FFu) == 0x40004400)
        write_serial(address & 0x3FF, value);
}
