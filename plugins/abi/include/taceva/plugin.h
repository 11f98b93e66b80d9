/* TacEva plugin interface, major 1: what every plugin exports and what every kind of device shares.
 *
 * A plugin is a shared library with exactly one exported symbol, a constant of type `taceva_plugin` called `taceva_plugin_v1`.
 * It is data: a host reads magic, size and version before any code of the plugin runs.
 *
 * Rules that hold everywhere
 *   units      m, unit quaternions, N, N mm, ns. A host rounds what crosses to 1 nm, 1e-9 degree and 1e-6 N mm, so that
 *              converting units loses nothing and a driver gives the same numbers however it is delivered.
 *   frame      the sensor's: x and y along the gel, z into it; forces are those that press on the gel.
 *   text       UTF-8 with a length, borrowed for the call; never NULL data with a length above 0.
 *   ownership  whoever allocates frees. What a plugin lends carries `release`. Nothing else is freed across the line.
 *   errors     a status that is not 0 comes with a message in the caller's `taceva_error`; there is no "last error".
 *   growth     every struct begins with its size in bytes as its writer knew it; fields beyond the smaller size count as zero.
 *              A function pointer that is NULL is an ability that is absent, never a fault.
 *   forbidden  exceptions or panics across the line, signal handlers, writing to standard output, changing the working directory,
 *              the locale or the environment.
 *
 * Tags such as [owner & open] say from which thread and in which state a function may be called:
 *   owner  one call at a time a handle, whichever thread makes it      any  from any thread, beside any other call
 */
#ifndef TACEVA_PLUGIN_H
#define TACEVA_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define TACEVA_EXPORT __declspec(dllexport)
#else
#define TACEVA_EXPORT __attribute__((visibility("default")))
#endif

#define TACEVA_MAGIC 0x31454154u /* "TAE1", little-endian */
#define TACEVA_ABI_MAJOR 1u      /* equal, or the library is refused */
#define TACEVA_ABI_MINOR 3u      /* may differ either way */

/* ---- status: the closed list of failures, 0 and below ---- */

typedef int32_t taceva_status;

#define TACEVA_OK 0
#define TACEVA_NOT_FOUND (-1)         /* the device, file or key is not there */
#define TACEVA_PERMISSION_DENIED (-2) /* this user may not */
#define TACEVA_BUSY (-3)              /* somebody else holds it */
#define TACEVA_TIMEOUT (-4)           /* not within the time given; the device stays usable */
#define TACEVA_DISCONNECTED (-5)      /* it was there, and is not any more */
#define TACEVA_UNSUPPORTED (-6)       /* it cannot do this at all */
#define TACEVA_INVALID_ARGUMENT (-7)  /* the caller's fault */
#define TACEVA_PROTOCOL (-8)          /* malformed data from the device */
#define TACEVA_OUT_OF_RANGE (-9)      /* beyond a limit of the device */
#define TACEVA_INTERRUPTED (-10)      /* `interrupt` or `halt` ended the call */
#define TACEVA_DEVICE_FAULT (-11)     /* the device reports a fault, or a number that is not finite */
#define TACEVA_ABI (-12)              /* the two sides do not understand each other */
#define TACEVA_END_OF_STREAM (-13)    /* nothing will come any more */
#define TACEVA_PANICKED (-14)         /* a bug of the plugin, caught; the handle is dead */
#define TACEVA_INTERNAL (-15)         /* a bug that was noticed */

/* ---- text and errors ---- */

typedef struct taceva_text {
  const char *data;
  size_t length;
} taceva_text;

#define TACEVA_MESSAGE_SIZE 504

/* Why a device stopped by itself: nothing moves after it until a person has looked. They begin as no text does, so that a message that ran on
 * is none; of those that begin so, one that is not listed counts as SERVO. */
typedef uint32_t taceva_fault;

#define TACEVA_FAULT_NONE 0u
#define TACEVA_FAULT_EMERGENCY_STOP 0xfa170001u /* somebody pressed it, or a guard opened */
#define TACEVA_FAULT_COLLISION 0xfa170002u      /* it struck something */
#define TACEVA_FAULT_BOUNDARY 0xfa170003u       /* it came to the border of where it may move */
#define TACEVA_FAULT_SERVO 0xfa170004u          /* a servo, a brake or the controller failed */

/* The caller's; a plugin writes no further than `size`. Hosts of minor 0 end before `fault`: TACEVA_ERROR_SIZE bytes. */
#define TACEVA_ERROR_SIZE 512
typedef struct taceva_error {
  uint32_t size;                     /* in: of this struct */
  int32_t vendor_code;               /* out: the device's own number, 0 for none */
  char message[TACEVA_MESSAGE_SIZE]; /* out: UTF-8, ends with a NUL, cut where it does not fit */
  taceva_fault fault;                /* out, since minor 1: only where `size` covers it */
} taceva_error;

/* Takes what a function lists or writes; `text` is borrowed for the call. */
typedef void (*taceva_take_text)(void *context, taceva_text text);

/* ---- arguments, checked by the host against what the manifest declares ---- */

#define TACEVA_ARG_TEXT 1u
#define TACEVA_ARG_WHOLE 2u
#define TACEVA_ARG_NUMBER 3u
#define TACEVA_ARG_FLAG 4u

typedef struct taceva_arg {
  taceva_text key;
  taceva_text text; /* the value as text, whatever its type */
  int64_t whole;    /* of a whole number; 0 or 1 for a flag */
  double number;    /* of a number, in the unit that the manifest declares */
  uint32_t kind;    /* TACEVA_ARG_... */
  uint32_t reserved;
} taceva_arg;

typedef struct taceva_args {
  const taceva_arg *items;
  size_t count;
} taceva_args;

/* ---- what the host offers; it outlives everything a plugin makes ---- */

#define TACEVA_LOG_ERROR 1
#define TACEVA_LOG_WARN 2
#define TACEVA_LOG_INFO 3
#define TACEVA_LOG_DEBUG 4

typedef struct taceva_host {
  uint32_t size;
  uint32_t abi_minor;
  void *context;
  void (*log)(void *context, int32_t level, taceva_text target, taceva_text message); /* [any] */
  uint64_t (*now_ns)(void *context);                                                  /* [any] CLOCK_MONOTONIC */
} taceva_host;

/* ---- when something was true, and when it was received ---- */

typedef struct taceva_stamp {
  uint64_t valid_ns;
  uint64_t received_ns; /* 0: not known */
} taceva_stamp;

/* ---- devices ---- */

/* The devices that are opened together: a plugin keeps here what they share, such as one connection. */
typedef struct taceva_rig taceva_rig;

/* The calls that every device has; each kind's table begins with it. Frozen: it never grows. */
typedef struct taceva_device_calls {
  uint32_t size; /* of the whole table of the kind */
  uint32_t reserved;
  void (*close)(void *handle);                              /* [owner & open] stops the device and frees it; the last call */
  void (*interrupt)(void *handle);                          /* [any & open] a blocked call returns INTERRUPTED within 50 ms; none pending: nothing */
  const void *(*extension)(void *handle, taceva_text id);   /* [owner & open] a table of calls on `handle`, or NULL; may be NULL */
} taceva_device_calls;

/* An open device, filled in by `open`. */
typedef struct taceva_device {
  void *handle;
  const taceva_device_calls *calls; /* the table of its kind; lives as long as the library */
} taceva_device;

/* The drivers of one kind, numbered from 0. */
typedef struct taceva_factory {
  uint32_t size;
  uint32_t drivers; /* how many */

  /* [any] Writes the `[[provides]]` table of the manifest as TOML, without that header and with `[[args]]` for `[[provides.args]]`, as it
   * holds for `args`: NULL for whatever they are, else every argument that is given or has a default. No device is touched. */
  taceva_status (*describe)(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error);

  /* [any] Names each device that is present, one text a device, "key=value;key=value": the arguments that choose it. May be NULL. */
  taceva_status (*discover)(uint32_t driver, taceva_take_text take, void *context, taceva_error *error);

  /* [any] Opens a device; nothing moves and no light changes. `rig` is NULL where the plugin has none. */
  taceva_status (*open)(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error);
} taceva_factory;

/* ---- the plugin ---- */

typedef struct taceva_plugin {
  uint32_t magic; /* TACEVA_MAGIC */
  uint32_t size;
  uint32_t abi_major;
  uint32_t abi_minor;
  taceva_text id;      /* reverse DNS, as in the manifest */
  taceva_text version; /* as in the manifest */

  taceva_status (*init)(const taceva_host *host, taceva_error *error); /* [once, first] may be NULL */
  void (*deinit)(void);                                                /* [once, last; not after a failed init] may be NULL */

  /* [any] `id` is "taceva.sensor/1", "taceva.robot/1", "taceva.force/2", "taceva.lighting/1" or, since minor 2, "taceva.changer/1": a
   * `taceva_factory`, or "taceva.estimator/1": a `taceva_estimator_factory`. NULL for a kind that the plugin does not provide. */
  const void *(*factory)(taceva_text id);

  /* What the devices of a rig share; all three may be NULL. */
  taceva_status (*open_rig)(taceva_rig **rig, taceva_error *error);      /* [any] */
  void (*close_rig)(taceva_rig *rig);                                    /* [owner] after the last device of the rig */
  const void *(*rig_extension)(taceva_rig *rig, taceva_text id);         /* [owner] a table of calls on the rig, or NULL */

  /* Since minor 1: what it must reach outside itself, a need of the manifest a line: "usb\ntcp:{host}:{port}". Only `taceva plugin manifest`
   * reads it; what is given to a plugin is what its manifest says and its user allows. Left out: it does not say. */
  taceva_text needs;
} taceva_plugin;

#define TACEVA_SENSOR_FACTORY "taceva.sensor/1"
#define TACEVA_ROBOT_FACTORY "taceva.robot/1"
#define TACEVA_FORCE_FACTORY "taceva.force/2" /* since minor 3: torques in N mm */
#define TACEVA_LIGHTING_FACTORY "taceva.lighting/1"
#define TACEVA_CHANGER_FACTORY "taceva.changer/1"
#define TACEVA_ESTIMATOR_FACTORY "taceva.estimator/1"

/* The one exported symbol:  TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1; */

#ifdef __cplusplus
}
#endif
#endif
