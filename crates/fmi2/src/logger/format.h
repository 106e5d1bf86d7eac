/* Formats from strangers: some FMUs pass finished text as the format, and a stray "100 % of" or "%n" in it would read or
 * even write through arguments that are not there. */
#ifndef TTB_FORMAT_H
#define TTB_FORMAT_H
#include <string.h>

/* Whether a format holds a conversion that is unknown, unfinished, or writes. */
static inline int format_is_odd(const char *format) {
    for (const char *p = format; (p = strchr(p, '%')) != NULL; p++) {
        p++;
        p += strspn(p, "-+#0'"); /* no blank: in "50 % of" it is text */
        p += strspn(p, "0123456789*");
        if (*p == '.') p += 1 + strspn(p + 1, "0123456789*");
        p += strspn(p, "hlqjztL");
        if (*p == '\0' || !strchr("diouxXeEfFgGaAcsp%", *p)) return 1;
    }
    return 0;
}
#endif
