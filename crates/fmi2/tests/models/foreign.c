/* A foreign FMU in C: n Reals in (value references 0 … n-1), the same out (n … 2n-1) after a step, and bad manners on
 * request: the instance name says which. Lacks the optional functions when compiled with -DPOOR. */
#include <stdlib.h>
#include <string.h>
#include <math.h>

#ifndef N
#define N 3
#endif
typedef void (*logger_t)(void *, const char *, int, const char *, const char *, ...);
typedef struct { logger_t logger; void *(*allocate)(size_t, size_t); void (*release)(void *); void *finished; void *environment; } callbacks_t;
typedef struct { const callbacks_t *callbacks; char name[32]; double in[N], rate[N], out[N]; int states; } instance_t;

int fmi2_live = 0; /* instances and states not yet freed */

const char *fmi2GetVersion(void) { return "2.0"; }
const char *fmi2GetTypesPlatform(void) { return "default"; }
static int is(instance_t *s, const char *name) { return strcmp(s->name, name) == 0; }

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks_t *callbacks, int visible, int logging) {
    (void)type; (void)visible;
    if (strcmp(name, "none") == 0) {
        callbacks->logger(callbacks->environment, name, 3, "error", "no licence for %s in %s", guid, resources);
        return NULL;
    }
    instance_t *s = callbacks->allocate(1, sizeof *s);
    s->callbacks = callbacks; /* kept, not copied, as many do */
    strncpy(s->name, name, sizeof s->name - 1);
    if (is(s, "odd")) {
        callbacks->logger(callbacks->environment, name, 0, "info", "loaded to 50 % of %n");
        callbacks->logger(callbacks->environment, name, 0, "info", "cut at %");
    }
    if (logging) callbacks->logger(callbacks->environment, name, 0, "info", "%d %s %.1f%%", 42, "reals", 99.5);
    fmi2_live++;
    return s;
}
void fmi2FreeInstance(void *c) { instance_t *s = c; fmi2_live--; s->callbacks->release(s); }
int fmi2SetupExperiment(void *c, int td, double t, double start, int sd, double stop) { (void)c; (void)td; (void)t; (void)start; (void)sd; (void)stop; return 0; }
int fmi2EnterInitializationMode(void *c) { (void)c; return 0; }
int fmi2ExitInitializationMode(void *c) { (void)c; return 0; }
int fmi2Terminate(void *c) { (void)c; return 0; }
int fmi2Reset(void *c) { memset(((instance_t *)c)->in, 0, sizeof(double) * 3 * N); return 0; }

int fmi2GetReal(void *c, const unsigned *vr, size_t n, double *values) {
    instance_t *s = c;
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= 2 * N) return 3;
        values[i] = vr[i] < N ? s->in[vr[i]] : s->out[vr[i] - N];
    }
    return 0;
}
int fmi2SetReal(void *c, const unsigned *vr, size_t n, const double *values) {
    instance_t *s = c;
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= N) return 3;
        s->in[vr[i]] = values[i];
    }
    return 0;
}
int fmi2DoStep(void *c, double t, double h, int no_restore) {
    instance_t *s = c;
    const callbacks_t *cb = s->callbacks;
    (void)no_restore;
    if (is(s, "warning")) { cb->logger(cb->environment, s->name, 1, "odd", "odd at %g", t); for (int i = 0; i < N; i++) s->out[i] = s->in[i]; return 1; }
    if (is(s, "chatty")) for (int i = 0; i < 1000; i++) cb->logger(cb->environment, s->name, 0, "info", "message %d", i);
    if (is(s, "long")) { static char text[10000]; memset(text, 'x', sizeof text - 1); cb->logger(cb->environment, s->name, 0, NULL, text); cb->logger(cb->environment, s->name, 0, NULL, NULL); }
    if (is(s, "error")) { s->out[0] += 1e9; cb->logger(cb->environment, s->name, 3, "bad", "cannot step by %g", h); return 3; }
    if (is(s, "discard")) return 2;
    if (is(s, "pending")) return 5;
    if (is(s, "fatal")) return 4;
    if (is(s, "nonsense")) return 99;
    for (int i = 0; i < N; i++) s->out[i] = s->in[i] + 0.5 * h * s->rate[i];
    if (is(s, "nan") && t > 0.015) s->out[1] = NAN;
    return 0;
}
#ifndef POOR
int fmi2SetRealInputDerivatives(void *c, const unsigned *vr, size_t n, const int *order, const double *values) {
    instance_t *s = c;
    for (size_t i = 0; i < n; i++) { if (order[i] != 1 || vr[i] >= N) return 3; s->rate[vr[i]] = values[i]; }
    return 0;
}
int fmi2GetFMUstate(void *c, void **state) {
    if (!*state) { *state = malloc(sizeof(instance_t)); fmi2_live++; }
    memcpy(*state, c, sizeof(instance_t));
    return 0;
}
int fmi2SetFMUstate(void *c, void *state) { memcpy(c, state, sizeof(instance_t)); return 0; }
int fmi2FreeFMUstate(void *c, void **state) { (void)c; if (*state) { free(*state); *state = NULL; fmi2_live--; } return 0; }
#endif
