/* A model that is fitted on features and predicts channels. All arrays belong to the caller and are contiguous, sample by sample. */
#ifndef TACEVA_ESTIMATOR_H
#define TACEVA_ESTIMATOR_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Training samples. Every number is finite. */
typedef struct taceva_training_set {
  uint32_t size;
  uint32_t channels;
  uint64_t samples;
  uint32_t height, width, depth, reserved; /* shape of one sample's features; a flat list is 1 x length x 1 */
  const float *features;                   /* [samples, height, width, depth] */
  const double *targets;                   /* [samples, channels] */
  const uint32_t *groups;                  /* [samples]: group of each sample, such as its contact point; NULL: unknown */
  const taceva_text *channel_names;        /* [channels]: "Px", "Fz" ... */
} taceva_training_set;

/* Callback with the progress of a fit, 0 to 1. After a nonzero return, the fit ends with INTERRUPTED. */
typedef int32_t (*taceva_progress)(void *context, double done);

typedef struct taceva_regressor_calls {
  uint32_t size;
  uint32_t reserved;
  void (*close)(void *handle); /* [owner & open] */
  /* [any & open] Reads `features`, [samples, height, width, depth], `features_length` numbers. Writes all of `into`, [samples, channels],
   * `into_length` numbers. If the lengths do not match the model's shape, returns INVALID_ARGUMENT and accesses neither array. Such a model may
   * come from untrusted bytes. */
  taceva_status (*predict)(const void *handle, const float *features, uint64_t features_length, uint64_t samples, double *into,
                           uint64_t into_length, taceva_error *error);
  /* [any & open] Writes the model as bytes that `load` accepts on every machine. `*length` is in: length of `into`, out: length of the model.
   * If `into` is NULL or too short, writes nothing to it and returns OUT_OF_RANGE. */
  taceva_status (*save)(const void *handle, uint8_t *into, uint64_t *length, taceva_error *error);
} taceva_regressor_calls;

typedef struct taceva_regressor {
  void *handle;
  const taceva_regressor_calls *calls;
} taceva_regressor;

typedef struct taceva_estimator_factory {
  uint32_t size;
  uint32_t estimators; /* number of estimators */
  /* [any] As `describe` of a `taceva_factory`. */
  taceva_status (*describe)(uint32_t estimator, taceva_take_text take, void *context, taceva_error *error);
  /* [any] `validation` may be NULL. */
  taceva_status (*fit)(uint32_t estimator, const taceva_args *settings, const taceva_training_set *training,
                       const taceva_training_set *validation, taceva_progress progress, void *context,
                       taceva_regressor *regressor, taceva_error *error);
  /* [any] Loads the bytes of `save`. Returns PROTOCOL for other bytes. */
  taceva_status (*load)(uint32_t estimator, const uint8_t *bytes, uint64_t length, taceva_regressor *regressor, taceva_error *error);
} taceva_estimator_factory;

#ifdef __cplusplus
}
#endif
#endif
