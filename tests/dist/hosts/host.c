/* Loads the library of an FMU as a program in C does, on Linux and on Windows, and runs it a little:

     host LIBRARY GUID RESOURCE_URI INPUT VALUE OUTPUT STEPS H

   INPUT and OUTPUT are value references. An empty RESOURCE_URI is passed as NULL. It prints the status and the output after STEPS
   steps and one more, which is taken twice from a saved state. At the end it loads and unloads the library some times. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef _WIN32
#include <windows.h>
#define OPEN(path) LoadLibraryExA(path, NULL, LOAD_WITH_ALTERED_SEARCH_PATH)
#define SYMBOL(library, name) ((void *)GetProcAddress(library, name))
#define CLOSE(library) FreeLibrary(library)
typedef HMODULE library_t;
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW | RTLD_LOCAL)
#define SYMBOL(library, name) dlsym(library, name)
#define CLOSE(library) dlclose(library)
typedef void *library_t;
#endif

typedef void *fmu_t;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void *finished, *environment;
} callbacks_t;

static void logger(void *environment, const char *name, int status, const char *category, const char *message, ...) {
    va_list arguments;
    (void)environment, (void)name;
    fprintf(stderr, "[%d %s] ", status, category);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fprintf(stderr, "\n");
}

int main(int argc, char **argv) {
    if (argc != 9) return 9;
    callbacks_t callbacks = {logger, calloc, free, NULL, NULL};
    const char *guid = argv[2], *resources = argv[3][0] ? argv[3] : NULL;
    unsigned input = atoi(argv[4]), output = atoi(argv[6]);
    double value = atof(argv[5]), once = 0, again = 1, h = atof(argv[8]);
    int steps = atoi(argv[7]), status = 0;
    void *state = NULL;

    for (int i = 0; i < 5; i++) {
        library_t library = OPEN(argv[1]);
        if (!library) {
            fprintf(stderr, "the library cannot be loaded\n");
            return 2;
        }
        const char *(*version)(void) = SYMBOL(library, "fmi2GetVersion");
        fmu_t (*instantiate)(const char *, int, const char *, const char *, const callbacks_t *, int, int) = SYMBOL(library, "fmi2Instantiate");
        int (*set_up)(fmu_t, int, double, double, int, double) = SYMBOL(library, "fmi2SetupExperiment");
        int (*enter)(fmu_t) = SYMBOL(library, "fmi2EnterInitializationMode");
        int (*leave)(fmu_t) = SYMBOL(library, "fmi2ExitInitializationMode");
        int (*terminate)(fmu_t) = SYMBOL(library, "fmi2Terminate");
        int (*step)(fmu_t, double, double, int) = SYMBOL(library, "fmi2DoStep");
        int (*get)(fmu_t, const unsigned *, size_t, double *) = SYMBOL(library, "fmi2GetReal");
        int (*set)(fmu_t, const unsigned *, size_t, const double *) = SYMBOL(library, "fmi2SetReal");
        int (*save)(fmu_t, void **) = SYMBOL(library, "fmi2GetFMUstate");
        int (*restore)(fmu_t, void *) = SYMBOL(library, "fmi2SetFMUstate");
        int (*forget)(fmu_t, void **) = SYMBOL(library, "fmi2FreeFMUstate");
        void (*release)(fmu_t) = SYMBOL(library, "fmi2FreeInstance");

        fmu_t fmu = instantiate("one", 1, guid, resources, &callbacks, 0, 0);
        if (!fmu) return 3;
        if (i == 0) {
            status |= set_up(fmu, 0, 0, 0, 0, 0) | enter(fmu) | leave(fmu) | set(fmu, &input, 1, &value);
            for (int k = 0; k < steps; k++) status |= step(fmu, k * h, h, 1);
            status |= save(fmu, &state);
            status |= step(fmu, steps * h, h, 0) | get(fmu, &output, 1, &once);
            status |= restore(fmu, state);
            status |= step(fmu, steps * h, h, 1) | get(fmu, &output, 1, &again);
            status |= forget(fmu, &state) | terminate(fmu);
            printf("%s %d %.17g %.17g\n", version(), status, once, again);
            fflush(stdout);
        }
        release(fmu);
        CLOSE(library);
    }
    return status;
}
