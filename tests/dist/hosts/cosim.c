/* Drives an FMU by libcosim's C library on Windows: cosim FMU INPUT VALUE OUTPUT STEPS STEP_NS; value references. It prints the
   output after the steps. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

#define FUNCTION(result, name, ...) result (*name)(__VA_ARGS__) = (void *)GetProcAddress(library, #name)

int main(int argc, char **argv) {
    HMODULE library = LoadLibraryA("cosimc.dll");
    if (argc != 7 || !library) return 2;
    FUNCTION(void *, cosim_execution_create, int64_t, int64_t);
    FUNCTION(void *, cosim_local_slave_create, const char *, const char *);
    FUNCTION(int, cosim_execution_add_slave, void *, void *);
    FUNCTION(void *, cosim_override_manipulator_create, void);
    FUNCTION(int, cosim_execution_add_manipulator, void *, void *);
    FUNCTION(int, cosim_manipulator_slave_set_real, void *, int, const uint32_t *, size_t, const double *);
    FUNCTION(void *, cosim_last_value_observer_create, void);
    FUNCTION(int, cosim_execution_add_observer, void *, void *);
    FUNCTION(int, cosim_observer_slave_get_real, void *, int, const uint32_t *, size_t, double *);
    FUNCTION(int, cosim_execution_step, void *, size_t);
    FUNCTION(const char *, cosim_last_error_message, void);

    uint32_t input = atoi(argv[2]), output = atoi(argv[4]);
    double value = atof(argv[3]), found = -1;
    void *execution = cosim_execution_create(0, atoll(argv[6]));
    void *slave = cosim_local_slave_create(argv[1], "fmu");
    if (!slave) {
        fprintf(stderr, "%s\n", cosim_last_error_message());
        return 3;
    }
    int index = cosim_execution_add_slave(execution, slave);
    void *manipulator = cosim_override_manipulator_create(), *observer = cosim_last_value_observer_create();
    cosim_execution_add_manipulator(execution, manipulator);
    cosim_execution_add_observer(execution, observer);
    cosim_manipulator_slave_set_real(manipulator, index, &input, 1, &value);
    int status = cosim_execution_step(execution, atoi(argv[5]));
    if (status) fprintf(stderr, "%s\n", cosim_last_error_message());
    cosim_observer_slave_get_real(observer, index, &output, 1, &found);
    printf("%.17g\n", found);
    return status;
}
