/* Draft extension of a rig: a simulated bench. Its clock advances as fast as the simulation, and the host changes its specimens. */
#ifndef TACEVA_EXT_BENCH_H
#define TACEVA_EXT_BENCH_H

#include "../../plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_BENCH "taceva.rig.bench/draft-1"

#define TACEVA_SPECIMEN_SPHERE 1u
#define TACEVA_SPECIMEN_LINE 2u
#define TACEVA_SPECIMEN_DOT 3u

typedef struct taceva_specimen {
  uint32_t size;
  uint32_t kind;   /* TACEVA_SPECIMEN_... */
  int64_t size_nm; /* the radius of a sphere, the spacing of a grating */
} taceva_specimen;

/* `bench` is the value of `rig=` with which the devices were opened. */
typedef struct taceva_bench_calls {
  uint32_t size;
  uint32_t reserved;
  uint64_t (*now_ns)(taceva_rig *rig, taceva_text bench);                                                          /* [any] */
  taceva_status (*rest)(taceva_rig *rig, taceva_text bench, uint64_t rest_ns, taceva_error *error);                /* [any] */
  taceva_status (*mount)(taceva_rig *rig, taceva_text bench, const taceva_specimen *specimen, taceva_error *error); /* [any] in the air only */
  taceva_status (*name_press)(taceva_rig *rig, taceva_text bench, uint64_t name, taceva_error *error);             /* [any] what is random in the next press is a function of the name */
  taceva_status (*schedule)(taceva_rig *rig, taceva_text bench, uint64_t at_ns, taceva_error *error);              /* [any] the next tare waits until then */
  taceva_status (*provenance)(taceva_rig *rig, taceva_text bench, taceva_take_text take, void *context, taceva_error *error); /* [any] */
} taceva_bench_calls;

#ifdef __cplusplus
}
#endif
#endif
