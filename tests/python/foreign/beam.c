/* A simply supported beam by its modes, as a bridge FMU of somebody else: FMI 2.0 co-simulation, no directional
 * derivatives, no interpolation of inputs.
 *
 *   value references: POINTS forces in kN, up; POINTS deflections in mm, up; POINTS velocities in m/s, up;
 *   POINTS positions in m; EI in N m2; mass in kg/m
 *
 * q'' + 2 zeta w q' + w^2 q = 2/(mu L) sum f sin(j pi x/L); the force is held, trapezoidal rule in SUBSTEPS parts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct { double f[POINTS], q[MODES], v[MODES], stiffness, mass; int stepped; } beam_t;
enum { OK = 0, ERROR = 3 };
static const double place[POINTS] = { PLACES };

static double shape(int j, int i) { return sin((j + 1) * M_PI * place[i] / LENGTH); }
static double omega(const beam_t *b, int j) { return pow((j + 1) * M_PI / LENGTH, 2) * sqrt(b->stiffness / b->mass); }
/* Rayleigh damping with RATIO at the first frequency and at four times it. */
static double damping(const beam_t *b, int j) {
    double w1 = omega(b, 0), w2 = 4 * w1, w = omega(b, j);
    return RATIO * 2 * w1 * w2 / (w1 + w2) + RATIO * 2 / (w1 + w2) * w * w;
}
static double load(const beam_t *b, int j) {
    double sum = 0;
    for (int i = 0; i < POINTS; i++) sum += 1e3 * b->f[i] * shape(j, i);
    return 2 / (b->mass * LENGTH) * sum;
}
const char *fmi2GetVersion(void) { return "2.0"; }
const char *fmi2GetTypesPlatform(void) { return "default"; }
int fmi2SetDebugLogging(void *c, int on, size_t n, const char *const *names) { (void)c; (void)on; (void)n; (void)names; return OK; }
void *fmi2Instantiate(const char *name, int type, const char *guid, const char *uri, const void *callbacks, int visible, int logging) {
    (void)name; (void)type; (void)uri; (void)callbacks; (void)visible; (void)logging;
    if (strcmp(guid, "deck-1") != 0) return NULL;
    beam_t *b = calloc(1, sizeof *b);
    b->stiffness = STIFFNESS;
    b->mass = MASS;
    return b;
}
void fmi2FreeInstance(void *c) { free(c); }
int fmi2SetupExperiment(void *c, int td, double tol, double start, int sd, double stop) { (void)c; (void)td; (void)tol; (void)start; (void)sd; (void)stop; return OK; }
int fmi2EnterInitializationMode(void *c) { (void)c; return OK; }
static void settle(beam_t *b) {
    for (int j = 0; j < MODES; j++) b->q[j] = load(b, j) / pow(omega(b, j), 2), b->v[j] = 0;
}
int fmi2ExitInitializationMode(void *c) { settle(c); ((beam_t *)c)->stepped = 1; return OK; }
int fmi2Terminate(void *c) { (void)c; return OK; }
int fmi2Reset(void *c) {
    beam_t *b = c;
    memset(b, 0, sizeof *b);
    b->stiffness = STIFFNESS;
    b->mass = MASS;
    return OK;
}
int fmi2SetReal(void *c, const unsigned *vr, size_t n, const double *value) {
    beam_t *b = c;
    for (size_t k = 0; k < n; k++) {
        if (vr[k] < POINTS) b->f[vr[k]] = value[k];
        else if (vr[k] == 4 * POINTS) b->stiffness = value[k];
        else if (vr[k] == 4 * POINTS + 1) b->mass = value[k];
        else return ERROR;
    }
    return OK;
}
int fmi2GetReal(void *c, const unsigned *vr, size_t n, double *value) {
    beam_t *b = c;
    if (!b->stepped) settle(b);
    for (size_t k = 0; k < n; k++) {
        unsigned what = vr[k] / POINTS, i = vr[k] % POINTS;
        value[k] = 0;
        if (what == 0) value[k] = b->f[i];
        for (int j = 0; j < MODES && (what == 1 || what == 2); j++) value[k] += shape(j, i) * (what == 1 ? 1e3 * b->q[j] : b->v[j]);
        if (what == 3) value[k] = place[i];
        if (what == 4) value[k] = i == 0 ? b->stiffness : b->mass;
    }
    return OK;
}
int fmi2DoStep(void *c, double t, double H, int keep) {
    beam_t *b = c;
    (void)t; (void)keep;
#ifdef CRASHES_AT
    if (t > CRASHES_AT) abort();
#endif
#ifdef HANGS_AT
    while (t > HANGS_AT) sleep(1);
#endif
    double h = H / SUBSTEPS;
    for (int j = 0; j < MODES; j++) {
        double p = load(b, j), w = omega(b, j), d = damping(b, j);
        for (int s = 0; s < SUBSTEPS; s++) {
            double mean = (2 * b->v[j] + h * (p - w * w * b->q[j])) / (2 + h * d + h * h * w * w / 2);
            b->q[j] += h * mean;
            b->v[j] = 2 * mean - b->v[j];
        }
    }
    return OK;
}
#ifndef NO_STATES
int fmi2GetFMUstate(void *c, void **state) {
    if (!*state) *state = malloc(sizeof(beam_t));
    memcpy(*state, c, sizeof(beam_t));
    return OK;
}
int fmi2SetFMUstate(void *c, void *state) { memcpy(c, state, sizeof(beam_t)); return OK; }
int fmi2FreeFMUstate(void *c, void **state) { (void)c; free(*state); *state = NULL; return OK; }
#endif
