/* SPDX-License-Identifier: MIT */
/* Whatever outputs, inputs and states are, to the bit, and in whatever order the library is called: it stays
 * inside the caller's arrays, which have the lengths of its macros, x̂ stays finite, u within its limits and d
 * ≥ 0. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t length);

static const model_t *const models[] = {&double_integrator, &two_mass, &correlated, &cross_noise,
                                        &random_walk};
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

/* Arrays on the heap, of exactly the lengths that the macros say. */
typedef struct {
    unsigned kind;
    const model_t *model;
    online_t online;
    lqg_kalman_steady_t steady;
    lqg_ekf_t ekf;
    lqg_rls_t rls;
    lqg_real gains[MAX_NX * MAX_NY], limits[MAX_NX], scale[MAX_NX], believable[MAX_NY];
    int bounded; /* the filter's state has bounds of 1/scale */
    lqg_real *x, *P, *U, *d, *u_applied, *innovation, *work;
    lqg_real *y, *u, *nu, *s;
    unsigned char *used;
    unsigned long *gated;
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

static size_t work_length(const machine_t *machine)
{
    const unsigned nx = machine->model->nx, ny = machine->model->ny;
    const size_t lengths[ESTIMATORS] = {LQG_KALMAN_STEADY_WORK(nx, ny), LQG_KALMAN_PLAIN_WORK(nx, ny),
                                        LQG_KALMAN_UD_WORK(nx, ny, nx), LQG_EKF_WORK(nx, ny, nx),
                                        LQG_RLS_WORK(nx)};
    return lengths[machine->kind];
}

static void make_arrays(machine_t *machine)
{
    const unsigned nx = machine->model->nx, nu = machine->model->nu, ny = machine->model->ny;
    machine->x = (lqg_real *)array(nx, sizeof(lqg_real));
    machine->P = (lqg_real *)array(LQG_KALMAN_PLAIN_P(nx), sizeof(lqg_real));
    machine->U = (lqg_real *)array(LQG_KALMAN_UD_U(nx), sizeof(lqg_real));
    machine->d = (lqg_real *)array(nx, sizeof(lqg_real));
    machine->u_applied = (lqg_real *)array(nu, sizeof(lqg_real));
    machine->innovation = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->work = (lqg_real *)array(work_length(machine), sizeof(lqg_real));
    machine->y = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->u = (lqg_real *)array(nu, sizeof(lqg_real));
    machine->nu = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->s = (lqg_real *)array(ny, sizeof(lqg_real));
    machine->used = (unsigned char *)array(ny, 1);
    machine->gated = (unsigned long *)array(ny, sizeof(unsigned long));
}

static void free_arrays(machine_t *machine)
{
    void *const arrays[] = {machine->x,          machine->P,    machine->U,    machine->d, machine->u_applied,
                            machine->innovation, machine->work, machine->y,    machine->u, machine->nu,
                            machine->s,          machine->used, machine->gated};
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
        machine->believable[i] = 512;
    if (!machine->bounded)
        return;
    machine->steady.x_scale = machine->online.plain.x_scale = machine->online.ud.x_scale = machine->scale;
    machine->steady.innovation_limit = machine->online.plain.innovation_limit = machine->believable;
    machine->online.ud.innovation_limit = machine->believable;
}

static void describe(machine_t *machine)
{
    const unsigned nx = machine->model->nx, ny = machine->model->ny;
    prepare_online(machine->model, &machine->online);
    const lqg_kalman_ud_t *ud = &machine->online.ud;
    const lqg_kalman_steady_t steady = {ud->plant, machine->gains, ud->M, ud->x0, NULL, NULL};
    const lqg_ekf_t ekf = {nx,    ny,    ud->nq, any_f,  any_h,  NULL,  machine,
                           ud->V, ud->G, ud->w,  ud->x0, ud->U0, ud->d0};
    const lqg_rls_t rls = {nx, 0.9f, 1, ud->x0, ud->d0, machine->limits};
    for (unsigned i = 0; i < MAX_NX * MAX_NY; i++)
        machine->gains[i] = 0.25f;
    for (unsigned i = 0; i < MAX_NX; i++)
        machine->limits[i] = 100;
    machine->steady = steady;
    machine->ekf = ekf;
    machine->rls = rls;
    bind(machine);
}

static void begin(machine_t *m)
{
    if (m->kind == STEADY)
        lqg_kalman_steady_init(&m->steady, m->x, m->u_applied, m->innovation);
    else if (m->kind == PLAIN)
        lqg_kalman_plain_init(&m->online.plain, m->x, m->P, m->u_applied, m->innovation);
    else if (m->kind == UD)
        lqg_kalman_ud_init(&m->online.ud, m->x, m->U, m->d, m->u_applied, m->innovation);
    else if (m->kind == EKF)
        lqg_ekf_init(&m->ekf, m->x, m->U, m->d);
    else
        lqg_rls_init(&m->rls, m->x, m->U, m->d);
    m->honest = 1;
}

static lqg_status update(machine_t *m, const lqg_watch_t *watch)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_update_watched(&m->steady, m->x, m->u_applied, m->innovation, m->y,
                                                m->online.V, watch, m->work);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_update_watched(&m->online.plain, m->x, m->P, m->u_applied, m->innovation,
                                               m->y, watch, m->work);
    if (m->kind == UD)
        return lqg_kalman_ud_update_watched(&m->online.ud, m->x, m->U, m->d, m->u_applied, m->innovation,
                                            m->y, watch, m->work);
    if (m->kind == EKF)
        return lqg_ekf_update(&m->ekf, m->x, m->U, m->d, m->y, m->u, watch, m->work);

    lqg_real *phi = (lqg_real *)array(m->model->nx, sizeof *phi);
    take(m->bytes, phi, m->model->nx * sizeof *phi);
    const lqg_status status = lqg_rls_update(&m->rls, m->x, m->U, m->d, phi, m->y[0], m->work);
    free(phi);
    return status;
}

static lqg_status update_alone(machine_t *m, unsigned i, const lqg_watch_t *watch)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_update_output(&m->steady, m->x, m->u_applied, m->innovation, i, m->y[i],
                                               m->online.V, watch);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_update_output(&m->online.plain, m->x, m->P, m->u_applied, m->innovation, i,
                                              m->y[i], watch, m->work);
    if (m->kind == UD)
        return lqg_kalman_ud_update_output(&m->online.ud, m->x, m->U, m->d, m->u_applied, m->innovation, i,
                                           m->y[i], watch, m->work);
    return update(m, watch);
}

static lqg_status predict(machine_t *m)
{
    if (m->kind == STEADY)
        return lqg_kalman_steady_predict(&m->steady, m->x, m->u_applied, m->innovation, m->u, m->work);
    if (m->kind == PLAIN)
        return lqg_kalman_plain_predict(&m->online.plain, m->x, m->P, m->u_applied, m->innovation, m->u,
                                        m->work);
    if (m->kind == UD)
        return lqg_kalman_ud_predict(&m->online.ud, m->x, m->U, m->d, m->u_applied, m->innovation, m->u,
                                     m->work);
    if (m->kind == EKF)
        return lqg_ekf_predict(&m->ekf, m->x, m->U, m->d, m->u, m->work);
    return update(m, NULL);
}

static void control(machine_t *m)
{
    const lqg_real u_min[1] = {-1}, u_max[1] = {2};
    lqg_real u[1];
    const lqg_lqr_t lqr = {m->model->nx, 1, m->gains, u_min, u_max};
    lqg_lqr_control(&lqr, m->x, u);
    demand(u[0] >= -1 && u[0] <= 2);
}

/* Bits for any of the state's arrays. */
static void spoil(machine_t *m)
{
    const unsigned nx = m->model->nx;
    lqg_real *const arrays[] = {m->x, m->P, m->U, m->d, m->u_applied, m->innovation};
    const unsigned lengths[] = {nx, LQG_TRIANGLE(nx), LQG_STRICT_TRIANGLE(nx),
                                nx, m->model->nu,     m->model->ny};
    const unsigned which = take_below(m->bytes, 6);
    take(m->bytes, arrays[which], lengths[which] * sizeof(lqg_real));
    m->honest = 0;
}

static void check(machine_t *m, lqg_status status)
{
    for (unsigned i = 0; i < m->model->nx; i++) {
        demand(m->x[i] - m->x[i] == 0);
        demand(!m->bounded || (m->x[i] * m->scale[i] > -1 && m->x[i] * m->scale[i] < 1));
        demand(!m->honest || m->kind < UD || m->d[i] >= 0);
    }
    if (status & LQG_STATE_RESET)
        m->honest = 1;
}

static void act(machine_t *m)
{
    enum { UPDATE, ALONE, PREDICT, CONTROL, SPOIL, ACTIONS };
    const unsigned ny = m->model->ny, action = take_below(m->bytes, ACTIONS);
    const lqg_watch_t watch = {m->used, (lqg_real)take_below(m->bytes, 8), m->gated, m->nu, m->s, NULL, NULL, NULL, NULL};
    const lqg_watch_t *maybe = take_below(m->bytes, 2) ? &watch : NULL;

    take(m->bytes, m->y, ny * sizeof *m->y);
    take(m->bytes, m->u, m->model->nu * sizeof *m->u);
    take(m->bytes, m->used, ny);
    if (action == UPDATE)
        check(m, update(m, maybe));
    else if (action == ALONE)
        check(m, update_alone(m, take_below(m->bytes, ny), maybe));
    else if (action == PREDICT)
        check(m, predict(m));
    else if (action == CONTROL)
        control(m);
    else
        spoil(m);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t length)
{
    static machine_t machine;
    bytes_t bytes = {data, length};

    memset(&machine, 0, sizeof machine);
    machine.bytes = &bytes;
    machine.kind = take_below(&bytes, ESTIMATORS);
    machine.model = models[take_below(&bytes, MODELS)];
    make_arrays(&machine);
    describe(&machine);
    begin(&machine);
    while (bytes.left)
        act(&machine);
    free_arrays(&machine);
    return 0;
}
