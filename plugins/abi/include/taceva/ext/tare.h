/* Extension of a force transducer: it can set the present load as zero. */
#ifndef TACEVA_EXT_TARE_H
#define TACEVA_EXT_TARE_H

#include "../plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_TARE "taceva.force.tare/1"

typedef struct taceva_tare_calls {
  uint32_t size;
  uint32_t reserved;
  taceva_status (*zero)(void *handle, uint64_t timeout_ns, taceva_error *error); /* [owner & started] returns once it holds */
} taceva_tare_calls;

#ifdef __cplusplus
}
#endif
#endif
