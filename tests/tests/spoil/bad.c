/* Stands before an FMU's library, which it is linked to, and misbehaves in steps from t = 0.1 s on. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { CRASH, ABORT, EXIT, HANG, ERROR, PRINT, SLOW };

int fmi2DoStep(void *c, double t, double h, int keep) {
    static int (*step)(void *, double, double, int);
    if (!step) step = (int (*)(void *, double, double, int))dlsym(RTLD_NEXT, "fmi2DoStep");
    if (WHAT == SLOW) usleep(5000);
    if (t > 0.0995) switch (WHAT) {
        case CRASH: { volatile int *volatile nowhere = 0; *nowhere = 1; } break;
        case ABORT: fprintf(stderr, "out of luck\n"); abort();
        case EXIT: exit(0);
        case HANG: for (;;) pause();
        case ERROR: return 3;
        case PRINT: printf("still here\n"); break;
    }
    return step(c, t, h, keep);
}
