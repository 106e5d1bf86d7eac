/* A bridge of one mass for FMI 2.0 co-simulation, and the faults an FMU can have, one per -D.
 *
 * N forces in (value references 0 … N-1), N displacements out (N … 2N-1), N velocities out (2N … 3N-1): the first mode
 * of a simply supported beam at N supports. The force is held over a step; implicit midpoint rule. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <fenv.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifndef N
#define N 49
#endif
#ifndef GUID
#define GUID "{faulty}"
#endif
#define LATE 0.3 /* s: when late faults show */

typedef void (*logger_t)(void *, const char *, int, const char *, const char *, ...);
typedef struct { logger_t logger; void *(*allocate)(size_t, size_t); void (*release)(void *); void *finished; void *environment; } callbacks_t;
typedef struct { double force[N], q, v, end, h; long steps; } state_t; /* end: of the last step */
typedef struct { const callbacks_t *callbacks; state_t now; double hidden; int initialized; } instance_t;
enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING };

#ifndef MASS
#define MASS 482950
#define STIFFNESS 6.24e8
#endif
#ifdef GAINS_ENERGY
static const double mass = MASS, stiffness = STIFFNESS, damping = -6e7;
#else
static const double mass = MASS, stiffness = STIFFNESS, damping = 1.7e6;
#endif

#ifdef STATIC_STATE
static state_t shared;
#define NOW(s) (&shared)
#else
#define NOW(s) (&(s)->now)
#endif

static int born; /* instances made so far */

static double shape(unsigned i) { return sin(M_PI * (i + 1) / (N + 1)); }
static double load(const state_t *s) {
    double sum = 0;
    for (unsigned i = 0; i < N; i++) sum += shape(i) * s->force[i];
    return sum;
}

const char *fmi2GetVersion(void) {
#ifdef OLD_LIBRARY
    return "1.0";
#else
    return "2.0";
#endif
}
const char *fmi2GetTypesPlatform(void) { return "default"; }
int fmi2SetDebugLogging(void *c, int on, size_t n, const char *const names[]) { (void)c; (void)on; (void)n; (void)names; return OK; }

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const callbacks_t *callbacks, int visible, int logging) {
    (void)name; (void)type; (void)resources; (void)visible; (void)logging;
#ifdef INSTANTIATE_CRASH
    *(volatile int *)8 = 1;
#endif
#ifdef INSTANTIATE_HANG
    for (;;) pause();
#endif
#ifdef INSTANTIATE_NULL
    callbacks->logger(callbacks->environment, name, ERROR, "error", "no licence");
    return NULL;
#endif
#ifndef GUID_UNCHECKED
    if (strcmp(guid, GUID) != 0) {
        callbacks->logger(callbacks->environment, name, ERROR, "error", "GUID %s, not %s", guid, GUID);
        return NULL;
    }
#endif
    born++;
#ifdef SHARED_STATE
    memset(&shared, 0, sizeof shared);
#endif
#ifdef SECOND_NULL
    if (born > 1) return NULL;
#endif
#ifdef SECOND_CRASH
    if (born > 1) *(volatile int *)8 = 1;
#endif
#ifdef URI_PICKY
    if (strncmp(resources, "file:///", 8) != 0) return NULL;
#endif
#ifdef URI_CRASH
    if (strncmp(resources, "file:///", 8) != 0) *(volatile int *)8 = 1;
#endif
#ifdef URI_NOT_DECODED
    if (strchr(resources, '%')) return NULL;
#endif
    instance_t *s = calloc(1, sizeof *s);
    s->callbacks = callbacks;
#ifdef LOG_NULL
    callbacks->logger(callbacks->environment, NULL, OK, NULL, NULL);
#endif
#ifdef LOG_NO_CATEGORY
    callbacks->logger(callbacks->environment, name, OK, NULL, "hello");
#endif
#ifdef LOG_ENVIRONMENT
    callbacks->logger(LOG_ENVIRONMENT, name, OK, "info", "hello");
#endif
#ifdef CHANGES_FOLDER
    if (chdir("/")) return NULL;
#endif
#ifdef CHANGES_UMASK
    umask(0777);
#endif
#ifdef CHANGES_SIGNALS
    for (int i = 1; i < 32; i++) signal(i, SIG_IGN);
#endif
#ifdef CHANGES_ROUNDING
    fesetround(FE_UPWARD);
#endif
#ifdef CLOSES_FILES
    for (int i = 3; i < 1024; i++) close(i);
#endif
#ifdef LEAVES_PROCESS
    if (!fork()) for (;;) pause();
#endif
#ifdef LOG_FORMAT
    callbacks->logger(callbacks->environment, name, OK, "info", "loaded to 100 %, %n and %Q are no formats");
#endif
#ifdef PRINTS
    printf("hello from the bridge\n");
    fflush(stdout);
#endif
    return s;
}
void fmi2FreeInstance(void *c) {
#ifdef FREE_CRASH
    *(volatile int *)8 = 1;
#endif
#ifdef FREE_ONLY_AFTER_TERMINATE
    if (((instance_t *)c)->initialized) abort();
#endif
    free(c);
}
int fmi2SetupExperiment(void *c, int td, double tol, double start, int sd, double stop) { (void)c; (void)td; (void)tol; (void)start; (void)sd; (void)stop; return OK; }
int fmi2EnterInitializationMode(void *c) { (void)c; return OK; }
int fmi2ExitInitializationMode(void *c) {
    instance_t *s = c;
#ifdef INITIALIZATION_ERROR
    s->callbacks->logger(s->callbacks->environment, "x", ERROR, "error", "no equilibrium");
    return ERROR;
#endif
    NOW(s)->q = load(NOW(s)) / stiffness;
    NOW(s)->v = 0;
    s->initialized = 1;
    return OK;
}
#ifndef NO_TERMINATE
int fmi2Terminate(void *c) { ((instance_t *)c)->initialized = 0; return OK; }
#endif
int fmi2Reset(void *c) {
    instance_t *s = c;
#ifdef RESET_KEEPS
    memset(NOW(s)->force, 0, sizeof NOW(s)->force);
    NOW(s)->end = 0;
    s->initialized = 0;
    s->hidden = NOW(s)->q; /* what stays of the run before */
#else
    memset(NOW(s), 0, sizeof(state_t));
    s->hidden = 0;
    s->initialized = 0;
#endif
    return OK;
}

int fmi2GetReal(void *c, const unsigned *vr, size_t n, double *values) {
    instance_t *s = c;
    const state_t *now = NOW(s);
    double q = now->q, v = now->v;
    if (!s->initialized && !now->steps) q = load(now) / stiffness, v = 0;
#ifdef RESET_KEEPS
    q += s->hidden;
#endif
#ifdef NAN_LATE
    if ((double)now->steps * now->h > LATE) q = NAN;
#endif
#ifdef INF_LATE
    if ((double)now->steps * now->h > LATE) v = INFINITY;
#endif
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= 3 * N) return ERROR;
#ifdef RANDOM
        if (vr[i] == 2 * N - 1) { values[i] = rand() % 4 ? 1.0 : 2.0; continue; } /* the last displacement */
#endif
#ifdef NEGATIVE_ZERO
        if (vr[i] == 2 * N - 1) { values[i] = born % 2 ? 0.0 : -0.0; continue; } /* the last displacement */
#endif
        values[i] = vr[i] < N ? now->force[vr[i]] : vr[i] < 2 * N ? q * shape(vr[i] - N) : v * shape(vr[i] - 2 * N);
    }
    return OK;
}
int fmi2SetReal(void *c, const unsigned *vr, size_t n, const double *values) {
    instance_t *s = c;
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= N) return ERROR;
        NOW(s)->force[vr[i]] = values[i];
    }
    return OK;
}
int fmi2DoStep(void *c, double t, double h, int no_restore) {
    instance_t *s = c;
    state_t *now = NOW(s);
    int late = t > LATE - 0.5 * h, status = OK;
    (void)no_restore; (void)late;
    const callbacks_t *cb = s->callbacks;
    (void)cb;
#if !defined(ANY_TIME) && !defined(STATIC_STATE)
    if (fabs(t - now->end) > 1e-6 * h + 1e-9 * fabs(t)) {
        cb->logger(cb->environment, "x", ERROR, "error", "a step from %g, the last one ended at %g", t, now->end);
        return ERROR;
    }
#endif
    now->end = t + h;
#ifdef DISCARD_LATE
    if (late) { cb->logger(cb->environment, "x", DISCARD, "info", "I give up at %g", t); return DISCARD; }
#endif
#ifdef ERROR_LATE
    if (late) { cb->logger(cb->environment, "x", ERROR, "error", "matrix is singular at %g", t); return ERROR; }
#endif
#ifdef FATAL_LATE
    if (late) return FATAL;
#endif
#ifdef PENDING_LATE
    if (late) return PENDING;
#endif
#ifdef STEP_CRASH
    if (late) *(volatile int *)8 = 1;
#endif
#ifdef STEP_ABORT
    if (late) abort();
#endif
#ifdef STEP_EXIT
    if (late) exit(0);
#endif
#ifdef STEP_EXIT_AT_ONCE
    if (late) _exit(7);
#endif
#ifdef STEP_ENDS_THREAD
    if (late) pthread_exit(NULL);
#endif
#ifdef STEP_COPIES
    static int copied;
    if (late && !copied++) fork(); /* both come back */
#endif
#ifdef STEP_CHANGES_ALL
    static int changed;
    if (late && !changed++) {
        fesetround(FE_UPWARD);
        feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW | FE_INEXACT);
        umask(0777);
        if (chdir("/")) return ERROR;
        for (int i = 1; i < 32; i++) if (i != SIGFPE) signal(i, SIG_IGN);
    }
#endif
#ifdef ENDS_LATE
    if (late) return DISCARD;
#endif
#ifdef LOGS_ESCAPES
    if (late) {
        cb->logger(cb->environment, "x", ERROR, "error", "\033]0;x\007\033[2J\xe2\x80\xaettb: fine\nttb: second line\r");
        return ERROR;
    }
#endif
#ifdef STEP_HANG
    if (late) for (;;) pause();
#endif
#ifdef WARNS
    cb->logger(cb->environment, "x", WARNING, "warning", "stiff at %g", t);
    status = WARNING;
#endif
#ifdef LEAKS
    static void *volatile lost;
    lost = memset(malloc(4096), 1, 4096);
#endif
#ifdef STDERR_CHATTER
    fprintf(stderr, "step %g\n", t);
#endif
#ifdef WRITES_FILE
    fclose(fopen("debug.log", "a"));
#endif
#ifdef FIXED_STEP
    if (now->steps && fabs(h - now->h) > 0) return ERROR;
#endif
#ifdef TINY_STEP_NAN
    if (h < 1e-12) now->v = NAN;
#endif
    double f = load(now);
    double vm = (2 * now->v + h / mass * (f - stiffness * now->q)) / (2 + h * damping / mass + 0.5 * h * h * stiffness / mass);
    now->q += h * vm;
    now->v = 2 * vm - now->v;
#ifdef HISTORY
    /* Something that belongs to the state and that nobody saves. */
    now->q += 1e-3 * s->hidden;
    s->hidden = now->q;
#endif
    now->h = h;
    now->steps++;
    return status;
}

int fmi2GetInteger(void *c, const unsigned *vr, size_t n, int *values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2GetBoolean(void *c, const unsigned *vr, size_t n, int *values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2GetString(void *c, const unsigned *vr, size_t n, const char **values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2SetInteger(void *c, const unsigned *vr, size_t n, const int *values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2SetBoolean(void *c, const unsigned *vr, size_t n, const int *values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2SetString(void *c, const unsigned *vr, size_t n, const char *const *values) { (void)c; (void)vr; (void)values; return n ? ERROR : OK; }
int fmi2SetRealInputDerivatives(void *c, const unsigned *vr, size_t n, const int *order, const double *values) { (void)c; (void)vr; (void)n; (void)order; (void)values; return ERROR; }
int fmi2GetRealOutputDerivatives(void *c, const unsigned *vr, size_t n, const int *order, double *values) { (void)c; (void)vr; (void)n; (void)order; (void)values; return ERROR; }
#ifndef NO_CANCEL
int fmi2CancelStep(void *c) { (void)c; return ERROR; }
#endif
int fmi2GetStatus(void *c, int kind, int *value) { (void)c; (void)kind; (void)value; return DISCARD; }
int fmi2GetRealStatus(void *c, int kind, double *value) { (void)c; (void)kind; (void)value; return DISCARD; }
int fmi2GetIntegerStatus(void *c, int kind, int *value) { (void)c; (void)kind; (void)value; return DISCARD; }
int fmi2GetBooleanStatus(void *c, int kind, int *value) {
    (void)c; (void)kind; (void)value;
#ifdef ENDS_LATE
    *value = kind == 3; /* fmi2Terminated */
    return OK;
#endif
    return DISCARD;
}
int fmi2GetStringStatus(void *c, int kind, const char **value) { (void)c; (void)kind; (void)value; return DISCARD; }

#ifndef NO_STATES
int fmi2GetFMUstate(void *c, void **state) {
    instance_t *s = c;
#ifdef GET_STATE_ERROR
    s->callbacks->logger(s->callbacks->environment, "x", ERROR, "error", "no room");
    return ERROR;
#endif
#ifdef STATE_NULL
    return OK;
#endif
#ifdef STATE_LEAK
    *state = NULL; /* forgets the one it was given */
#endif
    if (!*state) *state = calloc(1, sizeof(state_t));
    memcpy(*state, NOW(s), sizeof(state_t));
#ifdef SAVE_DISTURBS
    NOW(s)->v = 0;
#endif
    return OK;
}
int fmi2SetFMUstate(void *c, void *state) {
    instance_t *s = c;
    const state_t *saved = state;
#if defined(SET_NOTHING)
#elif defined(SET_FORGETS_VELOCITY)
    double v = NOW(s)->v;
    *NOW(s) = *saved;
    NOW(s)->v = v;
#elif defined(SET_FORGETS_INPUTS)
    NOW(s)->q = saved->q; NOW(s)->v = saved->v; NOW(s)->h = saved->h; NOW(s)->steps = saved->steps;
#elif defined(SET_ONLY_NEAR)
    if (NOW(s)->steps - saved->steps < 20) *NOW(s) = *saved;
#else
    *NOW(s) = *saved;
#endif
#ifdef SET_OFF_LATE
    if (saved->end > LATE - 0.1) NOW(s)->v += 1e-6;
#endif
    NOW(s)->end = saved->end; /* these faults are about motion */
    return OK;
}
int fmi2FreeFMUstate(void *c, void **state) {
    (void)c;
    free(*state);
#ifndef FREE_KEEPS_HANDLE
    *state = NULL;
#endif
    return OK;
}
int fmi2SerializedFMUstateSize(void *c, void *state, size_t *size) {
    (void)c; (void)state;
#if defined(SERIALIZED_TOO_LARGE)
    *size = (size_t)1 << 60;
#elif defined(SERIALIZED_TOO_SMALL)
    *size = sizeof(state_t) - 16;
#else
    *size = sizeof(state_t);
#endif
    return OK;
}
int fmi2SerializeFMUstate(void *c, void *state, char *bytes, size_t size) {
    (void)c; (void)size;
    memcpy(bytes, state, sizeof(state_t));
#ifdef SERIALIZED_WITHOUT_MOTION
    memset(bytes + sizeof(double) * N, 0, sizeof(double));
#endif
    return OK;
}
int fmi2DeSerializeFMUstate(void *c, const char *bytes, size_t size, void **state) {
    (void)c;
    if (!*state) *state = calloc(1, sizeof(state_t));
    memcpy(*state, bytes, size < sizeof(state_t) ? size : sizeof(state_t));
    return OK;
}
#endif
#ifndef NO_DERIVATIVES
int fmi2GetDirectionalDerivative(void *c, const unsigned *unknown, size_t n, const unsigned *known, size_t m, const double *seed, double *out) {
    state_t *now = NOW((instance_t *)c);
    double f = 0, h = now->h;
    for (size_t k = 0; k < m; k++) f += shape(known[k]) * seed[k];
    double vm = h / mass * f / (2 + h * damping / mass + 0.5 * h * h * stiffness / mass);
#ifdef WRONG_DERIVATIVES
    vm *= 1.5;
#endif
#ifdef WRONG_SIGN_DERIVATIVES
    vm = -vm;
#endif
    for (size_t i = 0; i < n; i++) {
        if (unknown[i] < N || unknown[i] >= 3 * N) return ERROR;
#ifdef MIXED_DERIVATIVES
        /* Velocities are states: forces do not change them at once. */
        if (unknown[i] >= 2 * N) { out[i] = 0; continue; }
#endif
#ifdef INSTANT_DERIVATIVES
        out[i] = 0;
        continue;
#endif
        out[i] = unknown[i] < 2 * N ? h * vm * shape(unknown[i] - N) : 2 * vm * shape(unknown[i] - 2 * N);
    }
    return OK;
}
#endif
