/* Calls into foreign code, and what such code may have done to the process; see mod.rs. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <sys/resource.h>
#include <sys/stat.h>
#if defined(__linux__)
#include <sys/syscall.h>
#include <ucontext.h>
#endif
#include "control.h"

/* Where a call of this thread goes on if the foreign code ends the process; NULL outside of such calls. */
static _Thread_local jmp_buf *place;
/* The process that is guarded, 0 before: a child made by fork ends as it likes. */
static pid_t guarded;
/* Whether foreign code has ended the process, and with which exit code. */
static volatile sig_atomic_t ended, end_code;

static int is_main_thread(void) {
#if defined(__linux__)
    return syscall(SYS_gettid) == getpid();
#else
    return pthread_main_np();
#endif
}

/* Whether this is a child that foreign code has made by fork: it must not come back to us, who would go on twice. */
static volatile sig_atomic_t is_copy;
static void in_child(void) { is_copy = 1; }
static void mark_copies(void) { pthread_atfork(NULL, NULL, in_child); }
static pthread_once_t copies_are_marked = PTHREAD_ONCE_INIT;

/* The end of the process, at once: what C code has printed is written, no handler runs. */
void ttb_exit_now(int code) {
    fflush(NULL);
#if defined(__linux__)
    for (;;) syscall(SYS_exit_group, code);
#else
    _exit(code);
#endif
}

/* Calls; 1 if the foreign code ended the process instead of coming back. */
int ttb_guarded(void (*work)(void *), void *with) {
    jmp_buf here, *volatile outer = place;
    control_t control;
    volatile int left = 0;
    pthread_once(&copies_are_marked, mark_copies);
    is_copy = 0; /* a child that we have made ourselves may call */
    read_control(&control);
    if (_setjmp(here) == 0) {
        place = &here;
        work(with);
    } else left = 1;
    place = outer;
    if (is_copy) ttb_exit_now(0);
    write_control(&control);
    return left;
}

/* Foreign code ends the process: its call comes to an end instead, or its thread. The main thread outside of a call is us. */
static void instead(int code) {
    if (guarded != getpid() || (!place && is_main_thread())) return;
    end_code = code;
    ended = 1;
    if (place) longjmp(*place, 1);
    for (;;) pause();
}

#if defined(__GLIBC__)
static void at_exit(int code, void *nothing) { (void)nothing; instead(code); }
static void at_quick_exit_(void) { instead(0); }
static int watched(void) { return on_exit(at_exit, NULL) | at_quick_exit(at_quick_exit_); }
#else
static void at_exit(void) { instead(0); }
static int watched(void) { return atexit(at_exit); }
#endif

#if defined(__linux__)
/* In place of the C library's for all code that finds its functions in the program (master/build.rs makes them visible). */
void _exit(int code) {
    instead(code);
    for (;;) syscall(SYS_exit_group, code);
}
void _Exit(int code) { _exit(code); }

/* The end of the thread that makes the call would be that of the program. */
void pthread_exit(void *value) {
    void (*real)(void *) = (void (*)(void *))dlsym(RTLD_NEXT, "pthread_exit");
    if (place) instead(0);
    if (real) real(value);
    for (;;) pause();
}
#endif

#if defined(__x86_64__) && defined(__linux__)
/* Foreign code has asked for a trap at a rounded or invalid result and got it: it goes on without. */
static void on_trap(int number, siginfo_t *what, void *where) {
    if (what->si_code < FPE_FLTDIV || what->si_code > FPE_FLTSUB) {
        signal(number, SIG_DFL); /* a division of integers by zero: it happens again, and ends the process */
        return;
    }
    fpregset_t registers = ((ucontext_t *)where)->uc_mcontext.fpregs;
    registers->mxcsr = (registers->mxcsr | 0x1f80) & ~0x3fu;
    registers->cwd |= 0x3f;
    registers->swd &= ~0x80ff;
}
static int without_traps(void) {
    struct sigaction action = { 0 };
    action.sa_sigaction = on_trap;
    action.sa_flags = SA_SIGINFO;
    return sigaction(SIGFPE, &action, NULL);
}
#else
static int without_traps(void) { return 0; }
#endif

int ttb_guard_arm(void) {
    if (guarded == getpid()) return 0;
    guarded = getpid();
    signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of writing, not the end */
    return watched() | without_traps();
}
int ttb_guard_ended(int *code) { *code = end_code; return ended; }

/* What belongs to the whole process, as it was. */
enum { SIGNALS = 5, LIMITS = 4 };
static const int signals[SIGNALS] = { SIGHUP, SIGINT, SIGPIPE, SIGTERM, SIGXFSZ };
static const int limits[LIMITS] = { RLIMIT_FSIZE, RLIMIT_NOFILE, RLIMIT_AS, RLIMIT_CPU };
static struct {
    int is_kept, sentinel;
    char *folder;
    dev_t device;
    ino_t inode;
    mode_t mask;
    struct sigaction actions[SIGNALS];
    struct rlimit limits[LIMITS];
    sigset_t blocked;
    control_t control;
} kept;

/* `folder` is the current one; `sentinel` a descriptor that nobody closes. */
void ttb_surroundings_keep(const char *folder, int sentinel) {
    struct stat here;
    kept.folder = strdup(folder);
    if (stat(".", &here) == 0) kept.device = here.st_dev, kept.inode = here.st_ino;
    kept.sentinel = sentinel;
    kept.mask = umask(077);
    umask(kept.mask);
    for (int i = 0; i < SIGNALS; i++) sigaction(signals[i], NULL, &kept.actions[i]);
    for (int i = 0; i < LIMITS; i++) getrlimit(limits[i], &kept.limits[i]);
    pthread_sigmask(SIG_SETMASK, NULL, &kept.blocked);
    read_control(&kept.control);
    kept.is_kept = 1;
}

/* Puts back what has changed, and says what: bits in the order of CHANGES in mod.rs. */
int ttb_surroundings_restore(void) {
    struct stat here;
    struct sigaction action;
    struct rlimit limit;
    sigset_t blocked;
    int changed = 0;
    if (!kept.is_kept) return 0;
    if (stat(".", &here) != 0 || here.st_dev != kept.device || here.st_ino != kept.inode)
        if (kept.folder && chdir(kept.folder) == 0) changed |= 1;
    if (umask(kept.mask) != kept.mask) changed |= 2;
    for (int i = 0; i < SIGNALS; i++) {
        if (sigaction(signals[i], NULL, &action) != 0 || action.sa_handler == kept.actions[i].sa_handler) continue;
        sigaction(signals[i], &kept.actions[i], NULL);
        changed |= 4;
    }
    pthread_sigmask(SIG_SETMASK, &kept.blocked, &blocked);
    for (int s = 1; s < 32; s++) if (sigismember(&blocked, s) != sigismember(&kept.blocked, s)) changed |= 8;
    for (int i = 0; i < LIMITS; i++) {
        if (getrlimit(limits[i], &limit) != 0) continue;
        if (limit.rlim_cur == kept.limits[i].rlim_cur && limit.rlim_max == kept.limits[i].rlim_max) continue;
        if (setrlimit(limits[i], &kept.limits[i]) != 0) {
            limit.rlim_cur = limit.rlim_max < kept.limits[i].rlim_cur ? limit.rlim_max : kept.limits[i].rlim_cur;
            setrlimit(limits[i], &limit);
        }
        changed |= 16;
    }
    if (write_control(&kept.control)) changed |= 32;
    if (kept.sentinel >= 0 && fcntl(kept.sentinel, F_GETFD) == -1) changed |= 64;
    return changed;
}
