/* What the library exports: one constant, and from there everything else. */
#include <string.h>
#include <taceva/plugin.h>

#include "waiting.h"

taceva_status open_sensor(uint32_t, const taceva_args *, taceva_rig *, taceva_device *, taceva_error *);
taceva_status open_force(uint32_t, const taceva_args *, taceva_rig *, taceva_device *, taceva_error *);

const taceva_host *host;

static taceva_status init(const taceva_host *of, taceva_error *error) {
  if (!of || of->size < sizeof *of || !of->now_ns) return failed(error, TACEVA_ABI, "the host has no clock");
  host = of;
  return TACEVA_OK;
}

/* As below [[provides]] of plugin.toml: a host refuses a difference. */
static const char SENSOR[] =
    "kind = \"sensor\"\nkey = \"bar\"\ntitle = \"a bar that walks\"\nsource = \"simulated\"\n"
    "frame = { width = 64, height = 48, format = \"gray8\" }\nrate_hz = 100\ngel = { opaque = true, markers = false }\n";
static const char FORCE[] =
    "kind = \"force\"\nkey = \"load\"\ntitle = \"a load at rest\"\nsource = \"simulated\"\n"
    "axes = [\"Fz\"]\nrate_hz = 200\nlimits = { Fz_max_N = 50 }\ntare = true\n"
    "[[args]]\nkey = \"load\"\ntype = \"number\"\nunit = \"N\"\nrange = [0, 60]\ndefault = 1\nhelp = \"what rests on it\"\n";

static taceva_status describe(const char *table, taceva_take_text take, void *context) {
  taceva_text text = {table, strlen(table)};
  take(context, text);
  return TACEVA_OK;
}

static taceva_status describe_sensor(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error) {
  (void)args;
  return driver == 0 ? describe(SENSOR, take, context) : failed(error, TACEVA_NOT_FOUND, "there is one sensor");
}

static taceva_status describe_force(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error) {
  (void)args;
  return driver == 0 ? describe(FORCE, take, context) : failed(error, TACEVA_NOT_FOUND, "there is one force transducer");
}

static const taceva_factory sensors = {sizeof sensors, 1, describe_sensor, NULL, open_sensor};
static const taceva_factory forces = {sizeof forces, 1, describe_force, NULL, open_force};

static int is(taceva_text text, const char *expected) {
  return text.length == strlen(expected) && !memcmp(text.data, expected, text.length);
}

static const void *factory(taceva_text id) {
  if (is(id, TACEVA_SENSOR_FACTORY)) return &sensors;
  if (is(id, TACEVA_FORCE_FACTORY)) return &forces;
  return NULL;
}

#define TEXT(literal) {literal, sizeof literal - 1}

TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1;
const taceva_plugin taceva_plugin_v1 = {
    TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR,
    TEXT("org.example.bar"), TEXT("1.0.0"), init, NULL, factory, NULL, NULL, NULL, {NULL, 0},
};
