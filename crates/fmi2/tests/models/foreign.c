/* A foreign FMU in C: n Reals in (value references 0 … n-1), the same out (n … 2n-1) after a step, and faults on
 * request: the instance name says which. Lacks the optional functions when compiled with -DPOOR. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
#include <unistd.h>
#include <pthread.h>

#ifndef N
#define N 3
#endif
typedef void (*logger_t)(void *, const char *, int, const char *, const char *, ...);
typedef struct { logger_t logger; void *(*allocate)(size_t, size_t); void (*release)(void *); void *finished; void *environment; } callbacks_t;
typedef struct { const callbacks_t *callbacks; char name[32]; double in[N], rate[N], out[N]; int states; } instance_t;

int fmi2_live = 0; /* instances and states not yet freed */

const char *fmi2GetVersion(void) { return "2.0"; }
const char *fmi2GetTypesPlatform(void) { return "default"; }
static void crash(void) { volatile int *volatile nowhere = 0; *nowhere = 1; }
static int is(instance_t *s, const char *name) { return strcmp(s->name, name) == 0; }

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks_t *callbacks, int visible, int logging) {
    (void)type; (void)visible;
    if (strcmp(name, "none") == 0) {
        callbacks->logger(callbacks->environment, name, 3, "error", "no licence for %s in %s", guid, resources);
        return NULL;
    }
    if (strcmp(name, "crash-at-wanted") == 0) crash();
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
void fmi2FreeInstance(void *c) {
    instance_t *s = c;
    if (is(s, "crash-at-end")) crash();
    if (is(s, "hang-at-end")) for (;;) pause();
    fmi2_live--; s->callbacks->release(s);
}
int fmi2SetupExperiment(void *c, int td, double t, double start, int sd, double stop) { (void)c; (void)td; (void)t; (void)start; (void)sd; (void)stop; return 0; }
int fmi2EnterInitializationMode(void *c) { (void)c; return 0; }
int fmi2ExitInitializationMode(void *c) { (void)c; return 0; }
int fmi2Terminate(void *c) { (void)c; return 0; }
int fmi2Reset(void *c) { memset(((instance_t *)c)->in, 0, sizeof(double) * 3 * N); return 0; }

int fmi2GetReal(void *c, const unsigned *vr, size_t n, double *values) {
    instance_t *s = c;
    static int reads = 0;
    if (is(s, "crash-on-get") && ++reads == 2) crash();
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
/* Goes on after the instance is freed: a faulty FMU. */
static void *chatter(void *callbacks) {
    const callbacks_t *cb = callbacks;
    for (;;) { cb->logger(cb->environment, "thread", 0, "info", "still here"); usleep(1000); }
    return NULL;
}
int fmi2DoStep(void *c, double t, double h, int no_restore) {
    instance_t *s = c;
    const callbacks_t *cb = s->callbacks;
    (void)no_restore;
    if (is(s, "warning")) { cb->logger(cb->environment, s->name, 1, "odd", "odd at %g", t); for (int i = 0; i < N; i++) s->out[i] = s->in[i]; return 1; }
    if (is(s, "chatty")) for (int i = 0; i < 1000; i++) cb->logger(cb->environment, s->name, 0, "info", "message %d", i);
    if (is(s, "long")) { static char text[10000]; memset(text, 'x', sizeof text - 1); cb->logger(cb->environment, s->name, 0, NULL, text); cb->logger(cb->environment, s->name, 0, NULL, NULL); }
    if (t >= 0.2 && is(s, "crash")) crash();
    if (t >= 0.2 && is(s, "abort")) { cb->logger(cb->environment, s->name, 3, "bad", "matrix is singular"); fprintf(stderr, "giving up\n"); abort(); }
    if (t >= 0.2 && is(s, "exit")) exit(0);
    if (t >= 0.2 && is(s, "hang")) for (;;) pause();
    if (t >= 0.2 && is(s, "spin")) for (volatile int i = 0;; i++) ;
    if (is(s, "print")) { printf("step to %g\n", t + h); fflush(stdout); fprintf(stderr, "no newline"); }
    if (is(s, "flood")) for (int i = 0; i < 20000; i++) printf("line %d of many\n", i);
    if (is(s, "thread")) { pthread_t thread; pthread_create(&thread, NULL, chatter, (void *)cb); pthread_detach(thread); }
    if (is(s, "parent") && fork() == 0) for (;;) pause();
    /* Out of its group and of its descent: a child of a child that has ended. */
    if (is(s, "daemon") && fork() == 0) { if (fork()) _exit(0); setsid(); for (int i = 0; i < 1024; i++) close(i); for (;;) pause(); }
    if (is(s, "mark")) { fwrite("\0ttb: end of output\0\n", 1, 21, stdout); printf("after it\n"); fflush(stdout); }
    if (is(s, "closer")) for (int i = 3; i < 1024; i++) close(i);
    if (is(s, "stranger")) {
        void *const strange[] = {s, (void *)1, NULL, (void *)-8};
        for (int i = 0; i < 4; i++) cb->logger(strange[i], s->name, 0, "info", "stranger %d", i);
    }
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
static int integer, boolean;
static char string[200000] = "Stra\xc3\x9f" "e";
int fmi2GetInteger(void *c, const unsigned *vr, size_t n, int *x) { (void)c; (void)n; *x = integer; return vr[0] == 7 ? 0 : 3; }
int fmi2SetInteger(void *c, const unsigned *vr, size_t n, const int *x) { (void)c; (void)n; integer = *x; return vr[0] == 7 ? 0 : 3; }
int fmi2GetBoolean(void *c, const unsigned *vr, size_t n, int *x) { (void)c; (void)n; *x = boolean; return vr[0] == 8 ? 0 : 3; }
int fmi2SetBoolean(void *c, const unsigned *vr, size_t n, const int *x) { (void)c; (void)n; boolean = *x; return vr[0] == 8 ? 0 : 3; }
int fmi2GetString(void *c, const unsigned *vr, size_t n, const char **x) { (void)c; (void)n; *x = string; return vr[0] == 9 ? 0 : 3; }
int fmi2SetString(void *c, const unsigned *vr, size_t n, const char *const *x) { (void)c; (void)n; strncpy(string, *x, sizeof string - 1); return vr[0] == 9 ? 0 : 3; }
int fmi2GetDirectionalDerivative(void *c, const unsigned *u, size_t n, const unsigned *k, size_t m, const double *seed, double *out) {
    (void)c;
    for (size_t i = 0; i < n; i++) for (size_t j = out[i] = 0; j < m; j++) out[i] += (u[i] + 0.5 * k[j]) * seed[j];
    return 0;
}
int fmi2SerializedFMUstateSize(void *c, void *state, size_t *size) { (void)c; (void)state; *size = 100000 + sizeof(instance_t); return 0; }
int fmi2SerializeFMUstate(void *c, void *state, char *bytes, size_t size) { (void)c; memset(bytes, 7, size); memcpy(bytes, state, sizeof(instance_t)); return 0; }
int fmi2SetRealInputDerivatives(void *c, const unsigned *vr, size_t n, const int *order, const double *values) {
    instance_t *s = c;
    if (is(s, "crash-on-set")) crash();
    for (size_t i = 0; i < n; i++) { if (order[i] != 1 || vr[i] >= N) return 3; s->rate[vr[i]] = values[i]; }
    return 0;
}
int fmi2GetFMUstate(void *c, void **state) {
    if (!*state) { *state = malloc(sizeof(instance_t)); fmi2_live++; }
    memcpy(*state, c, sizeof(instance_t));
    return 0;
}
int fmi2DeSerializeFMUstate(void *c, const char *bytes, size_t size, void **state) {
    int made = fmi2GetFMUstate(c, state);
    if (size != 100000 + sizeof(instance_t) || bytes[size - 1] != 7) return 3;
    memcpy(*state, bytes, sizeof(instance_t));
    return made;
}
int fmi2SetFMUstate(void *c, void *state) { memcpy(c, state, sizeof(instance_t)); return 0; }
int fmi2FreeFMUstate(void *c, void **state) { (void)c; if (*state) { free(*state); *state = NULL; fmi2_live--; } return 0; }
#endif
