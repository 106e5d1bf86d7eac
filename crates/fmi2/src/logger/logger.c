/* The logger an FMU gets from us: formats its message like printf and hands the text to Rust, with what is odd about the call.
 * In C because stable Rust cannot define a variadic function. The environment is handed over as a number: nobody looks where
 * it leads to. */
#include <stdarg.h>
#include <stdio.h>
#include "format.h"

typedef void logged_t(void *environment, int status, int oddities, const char *category, const char *text);
static logged_t *logged;

void ttb_fmi2_logger_to(logged_t *to) { logged = to; }

void ttb_fmi2_logger(void *environment, const char *instance, int status, const char *category, const char *message, ...) {
    char text[4096]; /* longer messages are cut */
    int odd = !message || format_is_odd(message);
    /* In the order of ODDITIES in mod.rs. */
    int oddities = (!instance) | (!category) << 1 | (!message) << 2 | (message && odd) << 3;
    va_list arguments;
    text[0] = '\0';
    if (odd) {
        snprintf(text, sizeof text, "%s", message ? message : "");
    } else {
        va_start(arguments, message);
        if (vsnprintf(text, sizeof text, message, arguments) < 0) snprintf(text, sizeof text, "(unprintable message)");
        va_end(arguments);
    }
    logged(environment, status, oddities, category, text);
}
