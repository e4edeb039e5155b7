/* SPDX-License-Identifier: MIT */
/* The balancing robot as two tasks of FreeRTOS: the loop, once a sample and before everything else, and the report. */
#include "../balancer.h"
#include "../hardware.h"
#include "../report.h"
#include "FreeRTOS.h"
#include "board.h"
#include "task.h"

enum { REPORT_PRIORITY = 1, LOOP_PRIORITY = 2 };
enum { REPORT_TICKS = configTICK_RATE_HZ / 5 };

static const TickType_t sample_ticks = (TickType_t)(BALANCING_ROBOT_SAMPLE_TIME * configTICK_RATE_HZ + 0.5f);

/* Words. Of the loop's 1024 bytes the simulated robot, whose sines are the deepest of it, uses 708 on a Cortex-M4F:
 * "free stack" in the report is what has never been used. */
enum { LOOP_STACK = 256, REPORT_STACK = 192 };

static balancer_t balancer;
static TaskHandle_t loop_task;

static int is_whole_ticks(float seconds)
{
    const float error = seconds * configTICK_RATE_HZ - (float)sample_ticks;

    return error < 1e-3f && error > -1e-3f;
}

static void run_loop(void *nothing)
{
    TickType_t last = xTaskGetTickCount();

    (void)nothing;
    for (;;) {
        balancer_run_sample(&balancer);
        if (xTaskDelayUntil(&last, sample_ticks) == pdFALSE)
            balancer_note_overrun(&balancer); /* the next sample is due already */
    }
}

static void run_report(void *nothing)
{
    TickType_t last = xTaskGetTickCount();

    (void)nothing;
    for (;;) {
        balancer_t now;

        taskENTER_CRITICAL();
        now = balancer;
        taskEXIT_CRITICAL();
        report_number("free stack ", (long)uxTaskGetStackHighWaterMark(loop_task) * (long)sizeof(StackType_t));
        report_text("  ");
        report_balancer(&now);
        (void)xTaskDelayUntil(&last, REPORT_TICKS);
    }
}

/* ---- called by the kernel ------------------------------------------------------------------------------- */

void vApplicationIdleHook(void);
void vApplicationStackOverflowHook(TaskHandle_t task, char *name);

void vApplicationIdleHook(void)
{
    __asm__ volatile("wfi");
}

void vApplicationStackOverflowHook(TaskHandle_t task, char *name)
{
    (void)task;
    (void)name;
    __builtin_trap();
}

/* --------------------------------------------------------------------------------------------------------- */

int main(void)
{
    static StackType_t loop_stack[LOOP_STACK], report_stack[REPORT_STACK];
    static StaticTask_t loop_memory, report_memory;

    configASSERT(is_whole_ticks(BALANCING_ROBOT_SAMPLE_TIME));
    uart_start();
    hardware_start();
    balancer_init(&balancer);
    loop_task = xTaskCreateStatic(run_loop, "loop", LOOP_STACK, NULL, LOOP_PRIORITY, loop_stack, &loop_memory);
    xTaskCreateStatic(run_report, "report", REPORT_STACK, NULL, REPORT_PRIORITY, report_stack, &report_memory);
    vTaskStartScheduler();
    return 1; /* the scheduler did not start */
}
