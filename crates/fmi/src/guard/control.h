/* Rounding, traps and flush to zero of this thread. */
#include <stdint.h>

#if defined(__x86_64__)
typedef struct { unsigned simd; unsigned short x87; } control_t;
static void read_control(control_t *c) {
    __asm__ volatile("stmxcsr %0" : "=m"(c->simd));
    __asm__ volatile("fnstcw %0" : "=m"(c->x87));
}
static int write_control(const control_t *c) {
    control_t now;
    read_control(&now);
    int changed = ((now.simd ^ c->simd) & ~0x3fu) || now.x87 != c->x87; /* the lowest bits are what has happened */
    if (changed) {
        __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(c->x87));
        __asm__ volatile("ldmxcsr %0" : : "m"(c->simd));
    }
    return changed;
}
#elif defined(__aarch64__)
typedef struct { uint64_t fpcr; } control_t;
static void read_control(control_t *c) { __asm__ volatile("mrs %0, fpcr" : "=r"(c->fpcr)); }
static int write_control(const control_t *c) {
    control_t now;
    read_control(&now);
    if (now.fpcr != c->fpcr) __asm__ volatile("msr fpcr, %0" : : "r"(c->fpcr));
    return now.fpcr != c->fpcr;
}
#else
typedef struct { int none; } control_t;
static void read_control(control_t *c) { c->none = 0; }
static int write_control(const control_t *c) { return c->none; }
#endif
