/* The logger of a probe: hands over the text and what is odd about the call. */
#include <stdarg.h>
#include <stdio.h>
#include "../import/format.h"

struct sink {
    void (*write)(void *sink, int status, int oddities, const char *text);
};

void ttb_fmi2_probe_logger(void *environment, const char *instance, int status, const char *category, const char *message, ...) {
    char text[1024];
    int odd = !message || format_is_odd(message);
    int oddities = (!instance) | (!category) << 1 | (!message) << 2 | (message && odd) << 3;
    va_list arguments;
    if (!environment) return;
    if (odd) snprintf(text, sizeof text, "%s", message ? message : "");
    else {
        va_start(arguments, message);
        if (vsnprintf(text, sizeof text, message, arguments) < 0) text[0] = '\0';
        va_end(arguments);
    }
    ((struct sink *)environment)->write(environment, status, oddities, text);
}
