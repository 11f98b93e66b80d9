/* Texts of the interface. They have a length and no final NUL. */
#ifndef TEXT_H
#define TEXT_H

#include <string.h>
#include <taceva/plugin.h>

static inline int is(taceva_text text, const char *expected) {
  return text.length == strlen(expected) && !memcmp(text.data, expected, text.length);
}

#endif
