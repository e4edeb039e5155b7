/* SPDX-License-Identifier: MIT */
/* Whatever outputs, inputs and states are, to the bit, and in whatever order the library is called: it stays
 * inside the caller's arrays, which have the lengths of its macros, x̂ stays finite, u within its limits and d
 * ≥ 0. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t length);

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise, &random_walk};
enum { MODELS = sizeof models / sizeof *models, STEADY = 0, PLAIN, UD, EKF, RLS, ESTIMATORS };

/* Bytes to be used up; then zeros. */
typedef struct {
    const uint8_t *data;
    size_t left;
} bytes_t;

static void demand(int condition)
{
    if (!condition)
        abort();
}

static void take(bytes_t *bytes, void *to, size_t length)
{
    const size_t present = length < bytes->left ? length : bytes->left;
    memset(to, 0, length);
    if (present)
        memcpy(to, bytes->data, present);
    bytes->data += present;
    bytes->left -= present;
}

static unsigned take_below(bytes_t *bytes, unsigned limit)
{
    uint8_t byte;
    take(bytes, &byte, 1);
    return byte % limit;
}

/* Memory on the heap, of exactly the lengths that the macros say. */
typedef struct {
    unsigned kind;
    const model_t *model;
    online_t online;
    lqg_kalman_steady_t steady;
    lqg_ekf_t ekf;
    lqg_rls_t rls;
    lqg_gate_t gate;
    lqg_real gains[MAX_NX * MAX_NY], limits[MAX_NX], scale[MAX_NX], plausible[MAX_NY];
    lqg_real start[MAX_NY], widen[MAX_NY], narrow[MAX_NY];
    int bounded; /* the filter's state has bounds of 1/scale */
    lqg_real *memory, *y, *u, *innovation, *S;
    unsigned char *heard;
    unsigned long *gated;
    lqg_kalman_steady_state_t steady_state;
    lqg_kalman_plain_state_t plain_state;
    lqg_kalman_ud_state_t ud_state;
    lqg_ekf_state_t ekf_state;
    lqg_rls_state_t rls_state;
    int honest; /* no state has come from the bytes since the last beginning */
    bytes_t *bytes;
} machine_t;

static void *array(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    demand(memory != NULL);
    return memory;
}

/* f and h with any results. */
static void any_f(void *context, lqg_real next[], lqg_real A[], const lqg_real x[], const lqg_real u[])
{
    machine_t *machine = (machine_t *)context;
    (void)x, (void)u;
    take(machine->bytes, next, machine->model->nx * sizeof *next);
    take(machine->bytes, A, machine->model->nx * machine->model->nx * sizeof *A);
}

static void any_h(void *context, lqg_real y[], lqg_real C[], const lqg_real x[], const lqg_real u[])
{
    machine_t *machine = (machine_t *)context;
    (void)x, (void)u;
    take(machine->bytes, y, machine->model->ny * sizeof *y);
    take(machine->bytes, C, machine->model->ny * machine->model->nx * sizeof *C);
}

static size_t memory_length(const machine_t *machine)
{
    const unsigned nx = machine->model->nx, nu = machine->model->nu, ny = machine->model->ny;
    const size_t lengths[ESTIMATORS] = {LQG_KALMAN_STEADY_MEMORY(nx, nu, ny), LQG_KALMAN_PLAIN_MEMORY(nx, nu, ny),
                                        LQG_KALMAN_UD_MEMORY(nx, nu, ny, nx), LQG_EKF_MEMORY(nx, ny, nx),
                                        LQG_RLS_MEMORY(nx)};
    return lengths[machine->kind];
}

/* The state of the machine's kind in its memory; the others' are not used. */
static void make_states(machine_t *m)
{
    const unsigned nx = m->model->nx, nu = m->model->nu, ny = m->model->ny;
    const lqg_kalman_steady_state_t steady = LQG_KALMAN_STEADY_STATE_IN(m->memory, nx, nu, ny);
    const lqg_kalman_plain_state_t plain = LQG_KALMAN_PLAIN_STATE_IN(m->memory, nx, nu, ny);
    const lqg_kalman_ud_state_t ud = LQG_KALMAN_UD_STATE_IN(m->memory, nx, nu, ny, nx);
    const lqg_ekf_state_t ekf = LQG_EKF_STATE_IN(m->memory, nx, ny, nx);
    const lqg_rls_state_t rls = LQG_RLS_STATE_IN(m->memory, nx);
    m->steady_state = steady;
    m->plain_state = plain;
    m->ud_state = ud;
    m->ekf_state = ekf;
    m->rls_state = rls;
    m->steady_state.gate.gated = m->plain_state.gate.gated = m->gated;
    m->ud_state.gate.gated = m->ekf_state.gate.gated = m->gated;
}

static void make_arrays(machine_t *machine)
{
    const unsigned nu = machine->model->nu, ny = machine->model->ny;
    machine->memory = (lqg_real *)array(memory_length(machine), sizeof(lqg_real));
    machine->y = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->u = (lqg_real *)array(nu, sizeof(lqg_real));
    machine->innovation = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->S = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->heard = (unsigned char *)array(ny, 1);
    machine->gated = (unsigned long *)array(ny, sizeof(unsigned long));
    make_states(machine);
}

static void free_arrays(machine_t *machine)
{
    void *const arrays[] = {machine->memory, machine->y,     machine->u,    machine->innovation,
                            machine->S,      machine->heard, machine->gated};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
}

/* Models of an even number of states have bounds; the others only have to stay finite. */
static void bind(machine_t *machine)
{
    machine->bounded = machine->model->nx % 2 == 0 && machine->kind <= UD;
    for (unsigned i = 0; i < MAX_NX; i++)
        machine->scale[i] = i % 2 ? 1 / 64.0f : 1 / 1024.0f;
    for (unsigned i = 0; i < MAX_NY; i++)
        machine->plausible[i] = 512;
    if (!machine->bounded)
        return;
    machine->steady.x_scale = machine->online.plain.x_scale = machine->online.ud.x_scale = machine->scale;
    machine->steady.innovation_limit = machine->online.plain.innovation_limit = machine->plausible;
    machine->online.ud.innovation_limit = machine->plausible;
}

static void describe(machine_t *machine)
{
    const unsigned nx = machine->model->nx, ny = machine->model->ny;
    prepare_online(machine->model, &machine->online);
    const lqg_kalman_ud_t *ud = &machine->online.ud;
    const lqg_kalman_steady_t steady = {ud->plant, machine->gains, ud->M, ud->x0, NULL, NULL, NULL, machine->online.V};
    const lqg_ekf_t ekf = {nx,    ny,    ud->nw, any_f,  any_h,  NULL,   machine,
                           ud->V, ud->G, ud->W,  ud->x0, ud->U0, ud->d0, NULL};
    const lqg_rls_t rls = {nx, 0.9f, 1, ud->x0, ud->d0, machine->limits};
    for (unsigned i = 0; i < MAX_NX * MAX_NY; i++)
        machine->gains[i] = 0.25f;
    for (unsigned i = 0; i < MAX_NX; i++)
        machine->limits[i] = 100;
    for (unsigned i = 0; i < MAX_NY; i++) {
        machine->start[i] = 1;
        machine->widen[i] = 1.5f;
        machine->narrow[i] = 0.5f;
    }
    machine->steady = steady;
    machine->ekf = ekf;
    machine->rls = rls;
    bind(machine);
}

static void begin(machine_t *m)
{
    if (m->kind == STEADY)
        lqg_kalman_steady_init(&m->steady, &m->steady_state);
    else if (m->kind == PLAIN)
        lqg_kalman_plain_init(&m->online.plain, &m->plain_state);
    else if (m->kind == UD)
        lqg_kalman_ud_init(&m->online.ud, &m->ud_state);
    else if (m->kind == EKF)
        lqg_ekf_init(&m->ekf, &m->ekf_state);
    else
        lqg_rls_init(&m->rls, &m->rls_state);
    m->honest = 1;
}

/* Any gate, or none. */
static void set_gate(machine_t *m)
{
    const unsigned sigma = take_below(m->bytes, 8);
    const int opens = take_below(m->bytes, 2) != 0;
    const lqg_gate_t gate = {(lqg_real)sigma, m->start, opens ? m->widen : NULL, opens ? m->narrow : NULL};
    m->gate = gate;
    m->steady.gate = m->online.plain.gate = m->online.ud.gate = m->ekf.gate = sigma ? &m->gate : NULL;
}

static lqg_status_t update(machine_t *m, unsigned long used, const lqg_watch_t *watch)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_partial_update(&m->steady, &m->steady_state, m->y, used, watch);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_partial_update(&m->online.plain, &m->plain_state, m->y, used, watch);
    if (m->kind == UD)
        return lqg_kalman_ud_partial_update(&m->online.ud, &m->ud_state, m->y, used, watch);
    if (m->kind == EKF)
        return lqg_ekf_partial_update(&m->ekf, &m->ekf_state, m->y, m->u, used, watch);

    lqg_real *phi = (lqg_real *)array(m->model->nx, sizeof *phi);
    take(m->bytes, phi, m->model->nx * sizeof *phi);
    const lqg_status_t status = lqg_rls_update(&m->rls, &m->rls_state, m->y[0], phi);
    free(phi);
    return status;
}

static lqg_status_t update_alone(machine_t *m, unsigned i, const lqg_watch_t *watch)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_update_output(&m->steady, &m->steady_state, &m->y[i], i, watch);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_update_output(&m->online.plain, &m->plain_state, &m->y[i], i, watch);
    if (m->kind == UD)
        return lqg_kalman_ud_update_output(&m->online.ud, &m->ud_state, &m->y[i], i, watch);
    return update(m, 1ul << i, watch);
}

static lqg_status_t predict(machine_t *m)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_predict(&m->steady, &m->steady_state, m->u);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_predict(&m->online.plain, &m->plain_state, m->u);
    if (m->kind == UD)
        return lqg_kalman_ud_predict(&m->online.ud, &m->ud_state, m->u);
    if (m->kind == EKF)
        return lqg_ekf_predict(&m->ekf, &m->ekf_state, m->u);
    return update(m, LQG_ALL_OUTPUTS, NULL);
}

/* x̂, or θ, is what the memory begins with; d where there is one. */
static const lqg_real *d_of(const machine_t *m)
{
    return m->kind == UD ? m->ud_state.d : m->kind == EKF ? m->ekf_state.d : m->rls_state.d;
}

static void control(machine_t *m)
{
    const lqg_real u_min[1] = {-1}, u_max[1] = {2};
    lqg_real u[1];
    const lqg_lqr_t lqr = {m->model->nx, 1, m->gains, u_min, u_max};
    lqg_lqr_control(&lqr, m->memory, u);
    demand(u[0] >= -1 && u[0] <= 2);
}

/* Any bits from somewhere in the memory on. */
static void spoil(machine_t *m)
{
    const size_t length = memory_length(m), from = take_below(m->bytes, (unsigned)length);
    take(m->bytes, m->memory + from, (1 + take_below(m->bytes, (unsigned)(length - from))) * sizeof(lqg_real));
    m->honest = 0;
}

static void check(machine_t *m, lqg_status_t status)
{
    const lqg_real *x = m->memory;
    for (unsigned i = 0; i < m->model->nx; i++) {
        demand(x[i] - x[i] == 0);
        demand(!m->bounded || (x[i] * m->scale[i] > -1 && x[i] * m->scale[i] < 1));
        demand(!m->honest || m->kind < UD || d_of(m)[i] >= 0);
    }
    if (status & LQG_STATE_RESET)
        m->honest = 1;
}

static void act(machine_t *m)
{
    enum { UPDATE, ALONE, PREDICT, CONTROL, SPOIL, ACTIONS };
    const unsigned ny = m->model->ny, action = take_below(m->bytes, ACTIONS);
    const lqg_watch_t watch = {m->innovation, m->S, m->heard};
    const lqg_watch_t *maybe = take_below(m->bytes, 2) ? &watch : NULL;

    take(m->bytes, m->y, ny * sizeof *m->y);
    take(m->bytes, m->u, m->model->nu * sizeof *m->u);
    set_gate(m);
    if (action == UPDATE)
        check(m, update(m, take_below(m->bytes, 4), maybe));
    else if (action == ALONE)
        check(m, update_alone(m, take_below(m->bytes, ny), maybe));
    else if (action == PREDICT)
        check(m, predict(m));
    else if (action == CONTROL)
        control(m);
    else
        spoil(m);
}

/* The law with limits: any numbers but for the limits, which are finite and low ≤ high. */
static lqg_real *any_reals(bytes_t *bytes, size_t count)
{
    lqg_real *reals = array(count, sizeof *reals);
    take(bytes, reals, count * sizeof *reals);
    return reals;
}

static void limit(bytes_t *bytes)
{
    const unsigned nx = 1 + take_below(bytes, 3), nu = 1 + take_below(bytes, 2), rows = nu + take_below(bytes, 5);
    lqg_real *const K = any_reals(bytes, nu * nx), *const F = any_reals(bytes, (rows - nu) * nx);
    lqg_real *const G = any_reals(bytes, rows * rows), *const scale = any_reals(bytes, rows);
    lqg_real *const tolerance = any_reals(bytes, rows), *const low = array(rows, sizeof *low);
    lqg_real *const high = array(rows, sizeof *high), *const u_step = array(nu, sizeof *u_step);
    lqg_real *const memory = array(LQG_MPC_MEMORY(rows), sizeof *memory), *const applied = any_reals(bytes, nu);
    unsigned char *const set = array(LQG_MPC_SET(rows), 1);
    const lqg_mpc_t mpc = {nx,  nu,   rows,      take_below(bytes, 32),
                           K,   F,    G,         scale,
                           low, high, tolerance, take_below(bytes, 2) ? u_step : NULL};
    lqg_mpc_state_t state = LQG_MPC_STATE_IN(memory, set, applied, rows);

    for (unsigned i = 0; i < rows; i++) {
        low[i] = (lqg_real)take_below(bytes, 255) - 128;
        high[i] = low[i] + (lqg_real)take_below(bytes, 255);
    }
    for (unsigned i = 0; i < nu; i++)
        u_step[i] = (lqg_real)take_below(bytes, 255);
    take(bytes, memory, LQG_MPC_MEMORY(rows) * sizeof *memory);
    take(bytes, set, LQG_MPC_SET(rows));
    while (bytes->left) {
        const int has_law = (int)take_below(bytes, 2);
        lqg_real *const x = any_reals(bytes, nx), *const u = any_reals(bytes, nu);
        (void)(has_law ? lqg_mpc_control(&mpc, &state, x, u) : lqg_mpc_limit(&mpc, &state, x, u));
        for (unsigned i = 0; i < nu; i++)
            demand(u[i] >= low[i] && u[i] <= high[i]);
        memcpy(applied, u, nu * sizeof *u);
        free(x);
        free(u);
    }
    for (size_t i = 0; i < 10; i++)
        free((void *[]){K, F, G, scale, tolerance, low, high, u_step, memory, applied}[i]);
    free(set);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t length)
{
    static machine_t machine;
    bytes_t bytes = {data, length};
    uint8_t kind;

    memset(&machine, 0, sizeof machine);
    machine.bytes = &bytes;
    kind = (uint8_t)take_below(&bytes, ESTIMATORS + 1);
    if (kind == ESTIMATORS) {
        limit(&bytes);
        return 0;
    }
    machine.kind = kind;
    machine.model = models[take_below(&bytes, MODELS)];
    make_arrays(&machine);
    describe(&machine);
    begin(&machine);
    while (bytes.left)
        act(&machine);
    free_arrays(&machine);
    return 0;
}
