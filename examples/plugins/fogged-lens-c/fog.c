/* A fault of pictures: a fogged lens takes contrast. The model of a fault is loaded from severity and size, and predicts the numbers of a picture
 * with the fault from those of the picture. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <taceva/estimator.h>

#define HEAD "taceva.fault/1\nseverity="

typedef struct {
  double left; /* remaining contrast */
  uint64_t length;
  uint8_t bytes[]; /* as loaded */
} fog;

static taceva_status failed(taceva_error *error, taceva_status status, const char *why) {
  const size_t head = offsetof(taceva_error, message);
  if (error && error->size > head) {
    size_t room = error->size - head;
    snprintf(error->message, room < TACEVA_MESSAGE_SIZE ? room : TACEVA_MESSAGE_SIZE, "%s", why);
  }
  return status;
}

static void close_fog(void *handle) { free(handle); }

/* A sample is a pixel, row by row from the top; a call has all pixels of one picture. */
static taceva_status predict(const void *handle, const float *features, uint64_t features_length, uint64_t samples, double *into,
                             uint64_t into_length, taceva_error *error) {
  const fog *it = handle;
  (void)samples;
  if (features_length != into_length || into_length == 0)
    return failed(error, TACEVA_INVALID_ARGUMENT, "expected as many numbers as the picture has");
  double mean = 0;
  for (uint64_t at = 0; at < features_length; at++) mean += features[at] / (double)features_length;
  for (uint64_t at = 0; at < into_length; at++) into[at] = mean + it->left * (features[at] - mean);
  return TACEVA_OK;
}

static taceva_status save(const void *handle, uint8_t *into, uint64_t *length, taceva_error *error) {
  const fog *it = handle;
  uint64_t room = into ? *length : 0;
  *length = it->length;
  if (room < *length) return failed(error, TACEVA_OUT_OF_RANGE, "the buffer is too short");
  memcpy(into, it->bytes, it->length);
  return TACEVA_OK;
}

static const taceva_regressor_calls calls = {sizeof calls, 0, close_fog, predict, save};

static taceva_status fit(uint32_t estimator, const taceva_args *settings, const taceva_training_set *training,
                         const taceva_training_set *validation, taceva_progress progress, void *context, taceva_regressor *regressor,
                         taceva_error *error) {
  (void)estimator, (void)settings, (void)training, (void)validation, (void)progress, (void)context, (void)regressor;
  return failed(error, TACEVA_UNSUPPORTED, "a fault is not fitted; name it by [[fault]] in a scene");
}

static taceva_status load(uint32_t estimator, const uint8_t *bytes, uint64_t length, taceva_regressor *regressor, taceva_error *error) {
  const size_t head = sizeof HEAD - 1;
  if (estimator != 0) return failed(error, TACEVA_NOT_FOUND, "there is one estimator");
  if (length <= head || memcmp(bytes, HEAD, head) != 0 || bytes[head] < '1' || bytes[head] > '5')
    return failed(error, TACEVA_PROTOCOL, "expected the lines of a fault with `severity` from 1 to 5");
  fog *made = malloc(sizeof *made + length);
  if (!made) return failed(error, TACEVA_INTERNAL, "no memory");
  made->left = 1.0 - 0.15 * (bytes[head] - '0');
  made->length = length;
  memcpy(made->bytes, bytes, length);
  regressor->handle = made;
  regressor->calls = &calls;
  return TACEVA_OK;
}

static taceva_status describe(uint32_t estimator, taceva_take_text take, void *context, taceva_error *error) {
  /* Same text as below [[provides]] of plugin.toml. */
  static const char TABLE[] = "kind = \"estimator\"\nkey = \"fog\"\ntitle = \"fault: a fogged lens\"\n";
  taceva_text text = {TABLE, sizeof TABLE - 1};
  if (estimator != 0) return failed(error, TACEVA_NOT_FOUND, "there is one estimator");
  take(context, text);
  return TACEVA_OK;
}

static const taceva_estimator_factory estimators = {sizeof estimators, 1, describe, fit, load};

static const void *factory(taceva_text id) {
  static const char KIND[] = TACEVA_ESTIMATOR_FACTORY;
  return id.length == sizeof KIND - 1 && memcmp(id.data, KIND, id.length) == 0 ? &estimators : NULL;
}

static taceva_status init(const taceva_host *host, taceva_error *error) {
  (void)host, (void)error;
  return TACEVA_OK;
}

#define TEXT(literal) {literal, sizeof literal - 1}

TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1;
const taceva_plugin taceva_plugin_v1 = {
    TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR,
    TEXT("org.example.fogged-lens-c"), TEXT("0.1.0"), init, NULL, factory, NULL, NULL, NULL, {NULL, 0},
};
