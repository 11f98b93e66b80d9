/* An estimator that predicts the mean of each channel. A saved model is "mean", the number of channels and the means, all little-endian. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <taceva/estimator.h>

#include "waiting.h"

#define CHANNELS_MAX 64u
#define HEAD 8u

typedef struct {
  uint32_t channels;
  double means[CHANNELS_MAX];
} model;

static void put(uint8_t *into, uint64_t bits, unsigned bytes) {
  for (unsigned at = 0; at < bytes; at++) into[at] = (uint8_t)(bits >> (8 * at));
}

static uint64_t get(const uint8_t *from, unsigned bytes) {
  uint64_t bits = 0;
  for (unsigned at = 0; at < bytes; at++) bits |= (uint64_t)from[at] << (8 * at);
  return bits;
}

static void close_model(void *handle) { free(handle); }

static taceva_status predict(const void *handle, const float *features, uint64_t features_length, uint64_t samples, double *into,
                             uint64_t into_length, taceva_error *error) {
  const model *it = handle;
  (void)features, (void)features_length;
  if (into_length % it->channels != 0 || into_length / it->channels != samples)
    return failed(error, TACEVA_INVALID_ARGUMENT, "the lengths do not match the channels of the model");
  for (uint64_t at = 0; at < into_length; at++) into[at] = it->means[at % it->channels];
  return TACEVA_OK;
}

static taceva_status save(const void *handle, uint8_t *into, uint64_t *length, taceva_error *error) {
  const model *it = handle;
  uint64_t room = into ? *length : 0;
  *length = HEAD + 8u * it->channels;
  if (room < *length) return failed(error, TACEVA_OUT_OF_RANGE, "the buffer is too short");
  memcpy(into, "mean", 4);
  put(into + 4, it->channels, 4);
  for (uint32_t channel = 0; channel < it->channels; channel++) {
    uint64_t bits;
    memcpy(&bits, &it->means[channel], sizeof bits);
    put(into + HEAD + 8 * channel, bits, 8);
  }
  return TACEVA_OK;
}

static const taceva_regressor_calls calls = {sizeof calls, 0, close_model, predict, save};

taceva_status fit_mean(uint32_t estimator, const taceva_args *settings, const taceva_training_set *training,
                       const taceva_training_set *validation, taceva_progress progress, void *context, taceva_regressor *regressor,
                       taceva_error *error) {
  (void)settings, (void)validation;
  if (estimator != 0) return failed(error, TACEVA_NOT_FOUND, "there is one estimator");
  if (training->samples == 0 || training->channels == 0 || training->channels > CHANNELS_MAX)
    return failed(error, TACEVA_INVALID_ARGUMENT, "expected samples of 1 to 64 channels");
  model *made = calloc(1, sizeof *made);
  if (!made) return failed(error, TACEVA_INTERNAL, "no memory");
  made->channels = training->channels;
  for (uint64_t sample = 0; sample < training->samples; sample++) {
    for (uint32_t channel = 0; channel < made->channels; channel++)
      made->means[channel] += training->targets[sample * made->channels + channel] / (double)training->samples;
    if (progress(context, (double)(sample + 1) / (double)training->samples)) {
      free(made);
      return failed(error, TACEVA_INTERRUPTED, "the fit was cancelled");
    }
  }
  regressor->handle = made;
  regressor->calls = &calls;
  return TACEVA_OK;
}

/* The bytes may be untrusted, so each number is checked before use. */
taceva_status load_mean(uint32_t estimator, const uint8_t *bytes, uint64_t length, taceva_regressor *regressor, taceva_error *error) {
  if (estimator != 0) return failed(error, TACEVA_NOT_FOUND, "there is one estimator");
  if (length < HEAD || memcmp(bytes, "mean", 4) != 0) return failed(error, TACEVA_PROTOCOL, "the bytes are not a model of this estimator");
  uint64_t channels = get(bytes + 4, 4);
  if (channels == 0 || channels > CHANNELS_MAX || length != HEAD + 8 * channels) return failed(error, TACEVA_PROTOCOL, "the model has the wrong length");
  model *made = calloc(1, sizeof *made);
  if (!made) return failed(error, TACEVA_INTERNAL, "no memory");
  made->channels = (uint32_t)channels;
  for (uint32_t channel = 0; channel < made->channels; channel++) {
    uint64_t bits = get(bytes + HEAD + 8 * channel, 8);
    memcpy(&made->means[channel], &bits, sizeof bits);
    if (!isfinite(made->means[channel])) {
      free(made);
      return failed(error, TACEVA_PROTOCOL, "a mean is not finite");
    }
  }
  regressor->handle = made;
  regressor->calls = &calls;
  return TACEVA_OK;
}
