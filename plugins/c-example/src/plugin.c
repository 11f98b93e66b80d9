/* Exported constant of the library, with access to all its functions. */
#include <taceva/estimator.h>

#include "text.h"
#include "waiting.h"

typedef taceva_status open_device(uint32_t, const taceva_args *, taceva_rig *, taceva_device *, taceva_error *);
open_device open_sensor, open_robot, open_force, open_lighting, open_changer;

taceva_status fit_mean(uint32_t, const taceva_args *, const taceva_training_set *, const taceva_training_set *, taceva_progress, void *,
                       taceva_regressor *, taceva_error *);
taceva_status load_mean(uint32_t, const uint8_t *, uint64_t, taceva_regressor *, taceva_error *);

const taceva_host *host;

static taceva_status init(const taceva_host *of, taceva_error *error) {
  if (!of || of->size < sizeof *of || !of->now_ns) return failed(error, TACEVA_ABI, "the host has no clock");
  host = of;
  return TACEVA_OK;
}

/* Same text as below [[provides]] of plugin.toml; a host rejects any difference. */
static const char SENSOR[] =
    "kind = \"sensor\"\nkey = \"bar\"\ntitle = \"a bar that walks\"\nsource = \"simulated\"\n"
    "frame = { width = 64, height = 48, format = \"gray8\" }\nrate_hz = 100\ngel = { opaque = true, markers = false }\n";
static const char ROBOT[] =
    "kind = \"robot\"\nkey = \"tip\"\ntitle = \"a tip without an arm\"\nsource = \"simulated\"\nguarded_motion = false\n"
    "workspace = { least_mm = [-20, -10, -10], greatest_mm = [20, 10, 10] }\nlimits = { speed_max_mm_s = 100 }\n";
static const char FORCE[] =
    "kind = \"force\"\nkey = \"load\"\ntitle = \"a load at rest\"\nsource = \"simulated\"\n"
    "axes = [\"Fz\"]\nrate_hz = 200\nlimits = { Fz_max_N = 50 }\ntare = true\nnumbered = true\n"
    "[[args]]\nkey = \"load\"\ntype = \"number\"\nunit = \"N\"\nrange = [0, 60]\ndefault = 1\nhelp = \"what rests on it\"\n";
static const char LIGHTING[] =
    "kind = \"lighting\"\nkey = \"lamp\"\ntitle = \"a light without a lamp\"\nsource = \"simulated\"\nscenes = [\"dark\", \"room\"]\n";
static const char CHANGER[] =
    "kind = \"changer\"\nkey = \"carousel\"\ntitle = \"two specimens\"\nsource = \"simulated\"\n"
    "holds = [\"sphere of radius 4 mm\", \"line grating of 1.5 mm\"]\n";
static const char ESTIMATOR[] = "kind = \"estimator\"\nkey = \"mean\"\ntitle = \"mean of each channel\"\n";

static taceva_status describe(uint32_t number, const char *table, taceva_take_text take, void *context, taceva_error *error) {
  taceva_text text = {table, strlen(table)};
  if (number != 0) return failed(error, TACEVA_NOT_FOUND, "there is one of each kind");
  take(context, text);
  return TACEVA_OK;
}

/* Factory of a kind with one driver, which `open` opens. */
#define FACTORY(name, table, open)                                                                                       \
  static taceva_status describe_##name(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context,   \
                                       taceva_error *error) {                                                            \
    (void)args;                                                                                                          \
    return describe(driver, table, take, context, error);                                                                \
  }                                                                                                                      \
  static const taceva_factory name = {sizeof name, 1, describe_##name, NULL, open};

FACTORY(sensors, SENSOR, open_sensor)
FACTORY(robots, ROBOT, open_robot)
FACTORY(forces, FORCE, open_force)
FACTORY(lightings, LIGHTING, open_lighting)
FACTORY(changers, CHANGER, open_changer)

static taceva_status describe_mean(uint32_t estimator, taceva_take_text take, void *context, taceva_error *error) {
  return describe(estimator, ESTIMATOR, take, context, error);
}

static const taceva_estimator_factory estimators = {sizeof estimators, 1, describe_mean, fit_mean, load_mean};

static const void *factory(taceva_text id) {
  if (is(id, TACEVA_SENSOR_FACTORY)) return &sensors;
  if (is(id, TACEVA_ROBOT_FACTORY)) return &robots;
  if (is(id, TACEVA_FORCE_FACTORY)) return &forces;
  if (is(id, TACEVA_LIGHTING_FACTORY)) return &lightings;
  if (is(id, TACEVA_CHANGER_FACTORY)) return &changers;
  if (is(id, TACEVA_ESTIMATOR_FACTORY)) return &estimators;
  return NULL;
}

#define TEXT(literal) {literal, sizeof literal - 1}

TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1;
const taceva_plugin taceva_plugin_v1 = {
    TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR,
    TEXT("org.example.bar"), TEXT("1.0.0"), init, NULL, factory, NULL, NULL, NULL, {NULL, 0},
};
