/* Extension of a force transducer: numbered readings. They distinguish a frozen signal from a constant load. */
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
  /* [owner & open] Number of the last reading, assigned by the device. A plugin must not count readings itself, because it would also count
   * repeated ones. The number may restart. NOT_FOUND before the first reading. */
  taceva_status (*sequence)(void *handle, uint64_t *sequence, taceva_error *error);
} taceva_numbered_calls;

#ifdef __cplusplus
}
#endif
#endif
