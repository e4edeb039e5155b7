/* SPDX-License-Identifier: MIT */
/* InvenSense, "MPU-6000 and MPU-6050 Register Map and Descriptions", revision 4.2; the bus as in RM0368, section
 * 18.3.3, "I2C master mode". Everything waits, but never for more than a thousand looks at a flag: at 16 MHz less than
 * a millisecond. */
#include "mpu6050.h"

#include "stm32f401.h"

enum { ADDRESS = 0x68 << 1, READ = 1 };
enum {
    CONFIG = 0x1A,
    GYRO_CONFIG = 0x1B,
    ACCEL_CONFIG = 0x1C,
    ACCEL_XOUT_H = 0x3B,
    PWR_MGMT_1 = 0x6B,
    WHO_AM_I = 0x75
};
enum { CLOCK_OF_GYROSCOPE = 1, FASTEST_FILTER = 0, RANGE_500_DEGREES = 1 << 3, RANGE_2_G = 0, IDENTITY = 0x68 };
enum { MHZ = 16, FAST_MODE = 1 << 15, SCL_OF_381_KHZ = 14, RISE_OF_300_NS = 5 };
enum { SCL = 8, SDA = 9, I2C_FUNCTION = 4, LOOKS = 1000 };

static const float g_of_step = 1.0f / 16384.0f;
static const float rate_of_step = 3.14159265f / 180.0f / 65.5f;

/* ---- the bus -------------------------------------------------------------------------------------------- */

void mpu6050_start_bus(void)
{
    RCC->ahb1enr |= RCC_GPIOB;
    RCC->apb1enr |= RCC_I2C1;
    GPIOB->otyper |= 1u << SCL | 1u << SDA; /* open drain: the sensor's board has the resistors */
    gpio_set_mode(GPIOB, SCL, GPIO_ALTERNATE, I2C_FUNCTION);
    gpio_set_mode(GPIOB, SDA, GPIO_ALTERNATE, I2C_FUNCTION);
}

/* Whatever happened on the bus before is forgotten. */
static void reset_bus(void)
{
    I2C1->cr1 = I2C_SWRST;
    I2C1->cr1 = 0;
    I2C1->cr2 = MHZ;
    I2C1->ccr = FAST_MODE | SCL_OF_381_KHZ;
    I2C1->trise = RISE_OF_300_NS;
    I2C1->cr1 = I2C_PE;
}

/* Returns 0, or −1 when the flag does not come, or the sensor does not acknowledge. */
static int wait_for(uint32_t flag)
{
    for (int i = 0; i < LOOKS; i++) {
        const uint32_t state = I2C1->sr1;

        if (state & I2C_AF)
            break;
        if (state & flag)
            return 0;
    }
    return -1;
}

/* While a stop is on its way the control register must not be written. */
static int wait_for_stop(void)
{
    for (int i = 0; i < LOOKS; i++)
        if (!(I2C1->cr1 & I2C_STOP))
            return 0;
    return -1;
}

static int start_with(uint32_t address)
{
    if (wait_for_stop() != 0)
        return -1;
    I2C1->cr1 = I2C_PE | I2C_START | I2C_ACK;
    if (wait_for(I2C_SB) != 0)
        return -1;
    I2C1->dr = address;
    if (wait_for(I2C_ADDR) != 0)
        return -1;
    (void)I2C1->sr2; /* read after sr1: clears ADDR */
    return 0;
}

static int send(uint8_t byte)
{
    I2C1->dr = byte;
    return wait_for(I2C_TXE);
}

static int write_register(uint8_t index, uint8_t value)
{
    if (start_with(ADDRESS) != 0 || send(index) != 0 || send(value) != 0 || wait_for(I2C_BTF) != 0)
        return -1;
    I2C1->cr1 = I2C_PE | I2C_STOP;
    return 0;
}

/* The last three bytes of a reading: the sensor must know before the last one that it is. */
static int receive_last_three(uint8_t *bytes)
{
    if (wait_for(I2C_BTF) != 0)
        return -1;
    I2C1->cr1 = I2C_PE; /* no acknowledgement any more */
    bytes[0] = (uint8_t)I2C1->dr;
    if (wait_for(I2C_BTF) != 0)
        return -1;
    I2C1->cr1 = I2C_PE | I2C_STOP;
    bytes[1] = (uint8_t)I2C1->dr;
    if (wait_for(I2C_RXNE) != 0)
        return -1;
    bytes[2] = (uint8_t)I2C1->dr;
    return 0;
}

/* At least three. */
static int read_registers(uint8_t first, uint8_t *bytes, unsigned count)
{
    if (start_with(ADDRESS) != 0 || send(first) != 0 || start_with(ADDRESS | READ) != 0)
        return -1;
    for (; count > 3; count--) {
        if (wait_for(I2C_RXNE) != 0)
            return -1;
        *bytes++ = (uint8_t)I2C1->dr;
    }
    return receive_last_three(bytes);
}

/* ---- the sensor ----------------------------------------------------------------------------------------- */

/* The bus reads three registers at least: those behind WHO_AM_I are reserved, read and forgotten. */
static int is_there(void)
{
    uint8_t bytes[3];

    return read_registers(WHO_AM_I, bytes, sizeof bytes) == 0 && bytes[0] == IDENTITY;
}

/* The fastest filter delays the gyroscope by 1 ms, a quarter of a sample. */
int mpu6050_start(void)
{
    reset_bus();
    return is_there() && write_register(PWR_MGMT_1, CLOCK_OF_GYROSCOPE) == 0 &&
                   write_register(CONFIG, FASTEST_FILTER) == 0 && write_register(GYRO_CONFIG, RANGE_500_DEGREES) == 0 &&
                   write_register(ACCEL_CONFIG, RANGE_2_G) == 0
               ? 0
               : -1;
}

static float number_at(const uint8_t *bytes)
{
    return (float)(int16_t)(uint16_t)(bytes[0] << 8 | bytes[1]);
}

int mpu6050_read(mpu6050_t *reading)
{
    enum { RATES = 8, COUNT = 14 }; /* accelerations, temperature, rates: two bytes each */
    uint8_t bytes[COUNT];

    if (read_registers(ACCEL_XOUT_H, bytes, COUNT) != 0)
        return -1;
    for (int i = 0; i < 3; i++) {
        reading->acceleration[i] = g_of_step * number_at(bytes + 2 * i);
        reading->rate[i] = rate_of_step * number_at(bytes + RATES + 2 * i);
    }
    return 0;
}
