/* An FMU that crashes when it is instantiated. */
#include <stddef.h>

#define EXPORT __declspec(dllexport)
#define NOTHING(name) EXPORT int name(void) { return 0; }

EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT void *fmi2Instantiate(void) { return (void *)*(volatile size_t *)NULL; }
NOTHING(fmi2FreeInstance) NOTHING(fmi2SetupExperiment) NOTHING(fmi2EnterInitializationMode) NOTHING(fmi2ExitInitializationMode)
NOTHING(fmi2Terminate) NOTHING(fmi2Reset) NOTHING(fmi2GetReal) NOTHING(fmi2SetReal) NOTHING(fmi2DoStep)
NOTHING(fmi2SetDebugLogging) NOTHING(fmi2GetInteger) NOTHING(fmi2SetInteger) NOTHING(fmi2GetBoolean) NOTHING(fmi2SetBoolean)
NOTHING(fmi2GetString) NOTHING(fmi2SetString)
