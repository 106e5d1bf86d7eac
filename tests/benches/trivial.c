/* A co-simulation FMU that does next to nothing: output i = constant - GAIN * (input i at the end of the step).
   State: inputs, their derivatives, outputs. */
#include <stdlib.h>
#include <string.h>

#define N 1000
typedef struct { double in[N], rate[N], out[N]; } State;

void *fmi2Instantiate(const char *n, int t, const char *g, const char *r, const void *f, int v, int l) { return calloc(1, sizeof(State)); }
void fmi2FreeInstance(void *c) { free(c); }
const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
int fmi2SetDebugLogging(void *c, int on, size_t n, const char *const *k) { return 0; }
int fmi2SetupExperiment(void *c, int d, double tol, double t0, int s, double t1) { return 0; }
int fmi2EnterInitializationMode(void *c) { return 0; }
int fmi2ExitInitializationMode(void *c) { return 0; }
int fmi2Terminate(void *c) { return 0; }
int fmi2Reset(void *c) { memset(c, 0, sizeof(State)); return 0; }
int fmi2GetReal(void *c, const unsigned *vr, size_t n, double *x) {
    State *s = c;
    for (size_t i = 0; i < n; i++) x[i] = vr[i] < N ? s->in[vr[i]] : s->out[vr[i] - N];
    return 0;
}
int fmi2SetReal(void *c, const unsigned *vr, size_t n, const double *x) {
    State *s = c;
    for (size_t i = 0; i < n; i++) s->in[vr[i]] = x[i];
    return 0;
}
int fmi2SetRealInputDerivatives(void *c, const unsigned *vr, size_t n, const int *order, const double *x) {
    State *s = c;
    for (size_t i = 0; i < n; i++) s->rate[vr[i]] = x[i];
    return 0;
}
int fmi2DoStep(void *c, double t, double h, int keep) {
    State *s = c;
    for (int i = 0; i < N; i++) s->out[i] = 1.0 + 0.1 * t - GAIN * (s->in[i] + h * s->rate[i]);
    return 0;
}
int fmi2GetFMUstate(void *c, void **state) {
    if (!*state) *state = malloc(sizeof(State));
    memcpy(*state, c, sizeof(State));
    return 0;
}
int fmi2SetFMUstate(void *c, void *state) { memcpy(c, state, sizeof(State)); return 0; }
int fmi2FreeFMUstate(void *c, void **state) { free(*state); *state = 0; return 0; }
int fmi2GetInteger(void *c, const unsigned *vr, size_t n, int *x) { return 3; }
int fmi2GetBoolean(void *c, const unsigned *vr, size_t n, int *x) { return 3; }
int fmi2GetString(void *c, const unsigned *vr, size_t n, const char **x) { return 3; }
int fmi2SetInteger(void *c, const unsigned *vr, size_t n, const int *x) { return 3; }
int fmi2SetBoolean(void *c, const unsigned *vr, size_t n, const int *x) { return 3; }
int fmi2SetString(void *c, const unsigned *vr, size_t n, const char *const *x) { return 3; }
