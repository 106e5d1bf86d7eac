/* Calls into foreign code on Windows; see mod.rs. Each library has the functions of its own C library, so that an end of the process
   from inside cannot be caught as on Unix. */
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>
#include "control.h"

/* The end of the process, at once: what C code has printed is written; libraries are not told. */
void ttb_exit_now(int code) {
    fflush(NULL);
    for (;;) TerminateProcess(GetCurrentProcess(), (UINT)code);
}

/* Calls; foreign code always comes back. */
int ttb_guarded(void (*work)(void *), void *with) {
    control_t control;
    read_control(&control);
    work(with);
    write_control(&control);
    return 0;
}

/* No box that waits for somebody to press a button, be it for a fault or for a library that is missing. */
int ttb_guard_arm(void) {
    SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
    return 0;
}
int ttb_guard_ended(int *code) { *code = 0; return 0; }

/* What belongs to the whole process, as it was. */
static struct {
    int is_kept;
    wchar_t *folder;
    control_t control;
} kept;

static wchar_t *current_folder(void) {
    DWORD length = GetCurrentDirectoryW(0, NULL);
    wchar_t *folder = malloc((length + 1) * sizeof(wchar_t));
    if (folder && !GetCurrentDirectoryW(length + 1, folder)) folder[0] = 0;
    return folder;
}

void ttb_surroundings_keep(const char *folder, int sentinel) {
    (void)folder, (void)sentinel;
    free(kept.folder);
    kept.folder = current_folder();
    read_control(&kept.control);
    kept.is_kept = 1;
}

/* Puts back what has changed, and says what: bits in the order of CHANGES in mod.rs. */
int ttb_surroundings_restore(void) {
    int changed = 0;
    if (!kept.is_kept) return 0;
    wchar_t *folder = current_folder();
    if (folder && kept.folder && wcscmp(folder, kept.folder) != 0 && SetCurrentDirectoryW(kept.folder)) changed |= 1;
    free(folder);
    if (write_control(&kept.control)) changed |= 32;
    return changed;
}
