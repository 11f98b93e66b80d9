/* Extension of a force transducer: its readings have numbers, by which a signal that froze is told from a load that rests. */
#ifndef TACEVA_EXT_NUMBERED_H
#define TACEVA_EXT_NUMBERED_H

#include "../plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_NUMBERED "taceva.force.numbered/1"

typedef struct taceva_numbered_calls {
  uint32_t size;
  uint32_t reserved;
  /* [owner & open] The number that the device itself gave the last reading: never one that the plugin counts, which would go on counting
   * while the device repeats itself. It may begin anew. NOT_FOUND before the first reading. */
  taceva_status (*sequence)(void *handle, uint64_t *sequence, taceva_error *error);
} taceva_numbered_calls;

#ifdef __cplusplus
}
#endif
#endif
