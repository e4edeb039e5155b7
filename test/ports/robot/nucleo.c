/* SPDX-License-Identifier: MIT */
/* The robot's firmware for the Nucleo-F401RE, the bytes that are flashed, on a model of its processor and of the robot:
 *
 *     nucleo robot_bare_metal.bin
 *
 * The processor's instructions are Unicorn's, its peripherals those of stm32_model.c, the robot that of ports/pc. It
 * lies, is held upright, let go and pushed, loses its sensor, falls, gets it back and is put up again. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unicorn/unicorn.h>

#include "../../../ports/pc/noise.h"
#include "../../../ports/pc/robot.h"
#include "stm32_model.h"

enum { FLASH = 0x08000000, RAM = 0x20000000, FLASH_SIZE = 512 * 1024, RAM_SIZE = 96 * 1024 };
enum { PERIPHERALS = 0x40000000, PERIPHERALS_SIZE = 0x30000, CORE = (int)0xE000E000, CORE_SIZE = 0x1000 };
enum { INSTRUCTIONS_MAX = 1000000 };

#define DEGREES (180.0 / 3.14159265358979)
#define SAMPLE_TIME 0.004

static uc_engine *processor;
static robot_t robot;
static unsigned failures;

static void require(int condition, const char *text)
{
    if (!condition && failures++ < 20)
        printf("failed: %s\n", text);
}

static void stop_if(uc_err error, const char *what)
{
    if (error == UC_ERR_OK)
        return;
    printf("%s: %s\n", what, uc_strerror(error));
    exit(1);
}

/* ---- the processor -------------------------------------------------------------------------------------- */

static uint64_t read_register(uc_engine *uc, uint64_t offset, unsigned size, void *base)
{
    (void)uc;
    (void)size;
    return stm32_read((uint32_t)((uintptr_t)base + offset));
}

static void write_register(uc_engine *uc, uint64_t offset, unsigned size, uint64_t value, void *base)
{
    (void)uc;
    (void)size;
    stm32_write((uint32_t)((uintptr_t)base + offset), (uint32_t)value);
}

static void map_registers(uint32_t base, uint32_t size)
{
    stop_if(uc_mmio_map(processor, base, size, read_register, (void *)(uintptr_t)base, write_register,
                        (void *)(uintptr_t)base),
            "registers");
}

static uint32_t word_at(uint32_t address)
{
    uint32_t word = 0;

    stop_if(uc_mem_read(processor, address, &word, sizeof word), "flash");
    return word;
}

static void flash(const char *path)
{
    static uint8_t image[FLASH_SIZE];
    FILE *file = fopen(path, "rb");
    size_t count;

    if (!file || (count = fread(image, 1, sizeof image, file)) == 0) {
        printf("Not found: %s\n", path);
        exit(1);
    }
    fclose(file);
    stop_if(uc_mem_write(processor, FLASH, image, count), "flash");
}

static void start_processor(const char *path)
{
    uint32_t stack;

    stop_if(uc_open(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS, &processor), "Unicorn");
    stop_if(uc_ctl_set_cpu_model(processor, UC_CPU_ARM_CORTEX_M4), "Cortex-M4");
    stop_if(uc_mem_map(processor, FLASH, FLASH_SIZE, UC_PROT_READ | UC_PROT_EXEC), "flash");
    stop_if(uc_mem_map(processor, RAM, RAM_SIZE, UC_PROT_ALL), "RAM");
    map_registers(PERIPHERALS, PERIPHERALS_SIZE);
    map_registers((uint32_t)CORE, CORE_SIZE);
    flash(path);
    stack = word_at(FLASH);
    stop_if(uc_reg_write(processor, UC_ARM_REG_SP, &stack), "stack");
}

static uint32_t program_counter(void)
{
    uint32_t pc = 0;

    stop_if(uc_reg_read(processor, UC_ARM_REG_PC, &pc), "program counter");
    return pc;
}

/* From the reset vector, or from where it was, to the next wfi. */
static uint32_t run_main(uint32_t from)
{
    const uc_err error = uc_emu_start(processor, from | 1, 0, 0, INSTRUCTIONS_MAX);
    const uint32_t pc = program_counter();

    stop_if(error, "main");
    require(word_at(pc - 2) << 16 == 0xBF300000u, "main has not come to its wfi");
    return pc;
}

/* The handler of SysTick, as the core calls it: all registers of main stay as they were. */
static void run_handler(void)
{
    enum { RETURN = FLASH + FLASH_SIZE - 4 };
    const uint32_t return_address = RETURN | 1;
    uc_context *context = NULL;

    stop_if(uc_context_alloc(processor, &context), "context");
    stop_if(uc_context_save(processor, context), "context");
    stop_if(uc_reg_write(processor, UC_ARM_REG_LR, &return_address), "return");
    stop_if(uc_emu_start(processor, word_at(FLASH + 15 * 4), RETURN, 0, INSTRUCTIONS_MAX), "handler");
    require(program_counter() == RETURN, "the handler has not returned");
    stop_if(uc_context_restore(processor, context), "context");
    uc_context_free(context);
}

/* ---- the robot ------------------------------------------------------------------------------------------ */

typedef enum { LIES, IS_HELD, IS_FREE } situation_t;

static void hold(double pitch)
{
    robot.wheel += pitch - robot.pitch;
    robot.pitch = pitch;
    robot.wheel_rate = robot.pitch_rate = 0.0;
}

static void let_a_sample_pass(situation_t situation, double push)
{
    double left, right;

    stm32_motors(&left, &right);
    require(fabs(left - right) < 0.5, "the motors do not pull together");
    if (situation == LIES)
        hold(1.2);
    else if (situation == IS_HELD)
        hold(0.0);
    else
        robot_run(&robot, 0.5 * (left + right), push + 0.002 * noise_normal(), SAMPLE_TIME);
    if (fabs(robot.pitch) > 1.2)
        hold(robot.pitch > 0.0 ? 1.2 : -1.2);
    world.pitch = robot.pitch;
    world.pitch_rate = robot.pitch_rate + 0.02 + 0.1 * noise_normal() / DEGREES;
    world.left = world.right = robot.wheel - robot.pitch;
}

static uint32_t pc_of_main;

static int drives(void)
{
    double left, right;

    stm32_motors(&left, &right);
    return fabs(left) + fabs(right) > 0.0;
}

static void run_samples(int count, situation_t situation, double push)
{
    while (count-- > 0) {
        stm32_sample_t last;

        let_a_sample_pass(situation, push);
        run_handler();
        pc_of_main = run_main(pc_of_main);
        last = stm32_begin_sample();
        require(last.fed > 0, "the watchdog was not fed");
        require(last.bus_seconds < 0.001, "the bus took more than a quarter of the sample");
    }
}

/* ---- its life ------------------------------------------------------------------------------------------- */

static void expect_report(const char *text)
{
    const char *said = stm32_serial();

    require(strstr(said, text) != NULL, text);
    if (!strstr(said, text))
        printf("it said: %s\n", said);
}

/* What it says of its voltage is what its motors get. */
static void expect_voltage(void)
{
    const char *said;
    double left, right;

    stm32_serial();
    do
        run_samples(1, IS_FREE, 0.0);
    while (!(said = strstr(stm32_serial(), "voltage ")));
    stm32_motors(&left, &right);
    require(fabs(atof(said + strlen("voltage ")) / 1000.0 - 0.5 * (left + right)) < 0.02,
            "not the voltage that was reported");
}

static void put_it_up(const char *before)
{
    stm32_serial();
    run_samples(240, IS_HELD, 0.0);
    expect_report(before);
    run_samples(300, IS_HELD, 0.0);
    require(!drives(), "drives before it is let go");
    expect_report("is ready");
    run_samples(500, IS_FREE, 0.0);
    require(drives(), "does not drive");
    expect_report("balances");
    require(fabs(robot.pitch) < 0.05, "does not stand");
}

static void live(void)
{
    require(fabs(stm32_sample_time() - SAMPLE_TIME) < 1e-9, "SysTick is not the sample time");
    require(stm32_watchdog_time() > 2.0 * SAMPLE_TIME && stm32_watchdog_time() < 0.05, "the watchdog's time");
    require(!drives(), "drives at the start");
    run_samples(300, LIES, 0.0);
    require(!drives(), "drives while lying");
    expect_report("waits to be held upright");
    put_it_up("waits to be held upright");

    run_samples(25, IS_FREE, 0.15);
    require(fabs(robot.pitch) > 0.02, "the push did nothing");
    expect_voltage();
    run_samples(500, IS_FREE, 0.0);
    require(fabs(robot.pitch) < 0.05 && drives(), "does not survive a push");

    world.sensor_is_dead = 1;
    run_samples(26, IS_FREE, 0.0);
    require(!drives(), "drives without sensor");
    run_samples(474, IS_FREE, 0.0);
    expect_report("waits for its sensors");
    require(fabs(robot.pitch) > 1.0, "stands without motors");
    world.sensor_is_dead = 0;
    put_it_up("lost a sensor");
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    start_processor(argv[1]);
    world.pitch = 1.2;
    hold(1.2);
    pc_of_main = run_main(word_at(FLASH + 4));
    stm32_begin_sample();
    live();
    uc_close(processor);
    printf("%u failures, %u complaints\n", failures, stm32_complaints);
    return failures || stm32_complaints ? 1 : 0;
}
