/* The logger an FMU gets from us: formats its message like printf and hands the text to Rust.
 * In C because stable Rust cannot define a variadic function. The environment pointer leads to a sink whose first field
 * is the Rust function, so that no symbol of ours needs to be visible to anyone. */
#include <stdarg.h>
#include <stdio.h>
#include "format.h"

struct sink {
    void (*write)(void *sink, int status, const char *category, const char *text);
};

void ttb_fmi2_logger(void *environment, const char *instance, int status, const char *category, const char *message, ...) {
    char text[4096]; /* longer messages are cut */
    va_list arguments;
    (void)instance;
    if (!environment) return;
    text[0] = '\0';
    if (message && format_is_odd(message)) {
        snprintf(text, sizeof text, "%s", message);
    } else if (message) {
        va_start(arguments, message);
        if (vsnprintf(text, sizeof text, message, arguments) < 0) snprintf(text, sizeof text, "(unprintable message)");
        va_end(arguments);
    }
    ((struct sink *)environment)->write(environment, status, category, text);
}
