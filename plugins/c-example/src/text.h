/* Texts of the interface, which end at their length and not at a 0. */
#ifndef TEXT_H
#define TEXT_H

#include <string.h>
#include <taceva/plugin.h>

static inline int is(taceva_text text, const char *expected) {
  return text.length == strlen(expected) && !memcmp(text.data, expected, text.length);
}

#endif
