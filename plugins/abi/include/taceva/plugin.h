/* TacEva plugin interface, major version 1: the export of a plugin, and the types that all kinds of device share.
 *
 * A plugin is a shared library with exactly one exported symbol, a constant of type `taceva_plugin` called `taceva_plugin_v1`.
 * The symbol is data: a host reads magic, size and version before any code of the plugin runs.
 *
 * General rules
 *   units      m, unit quaternions, N, N mm, ns. A host rounds numbers at the interface to 1 nm, 1e-9 degree and 1e-6 N mm.
 *              Unit conversion then loses nothing, and a driver gives equal numbers in every kind of plugin.
 *   frame      frame of the sensor: x and y along the gel, z into it. Forces act on the gel.
 *   text       UTF-8 with a length, borrowed for the call; never NULL data with a length above 0.
 *   ownership  the side that allocates memory frees it. Memory that a plugin lends has a `release` function.
 *   errors     a status other than 0 comes with a message in the `taceva_error` of the caller.
 *   growth     every struct that can grow begins with its size in bytes; fields beyond the smaller size count as zero.
 *              A NULL function pointer is a missing ability, not an error.
 *   forbidden  exceptions or panics across the interface, signal handlers, writing to standard output, changing the working directory,
 *              the locale or the environment.
 *
 * Tags such as [owner & open] state the thread and the state in which a function may be called:
 *   owner  from any thread, one call at a time per handle      any  from any thread, concurrently with any other call
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
#define TACEVA_ABI_MAJOR 1u      /* equal on both sides, or the library is rejected */
#define TACEVA_ABI_MINOR 4u      /* may differ between the sides */

/* ---- status: the closed list of failures, 0 and below ---- */

typedef int32_t taceva_status;

#define TACEVA_OK 0
#define TACEVA_NOT_FOUND (-1)         /* the device, file or key does not exist */
#define TACEVA_PERMISSION_DENIED (-2) /* this user lacks the permission */
#define TACEVA_BUSY (-3)              /* another program holds the device */
#define TACEVA_TIMEOUT (-4)           /* the timeout expired; the device stays usable */
#define TACEVA_DISCONNECTED (-5)      /* the device has gone */
#define TACEVA_UNSUPPORTED (-6)       /* the operation is not supported */
#define TACEVA_INVALID_ARGUMENT (-7)  /* an argument of the caller is wrong */
#define TACEVA_PROTOCOL (-8)          /* malformed data from the device */
#define TACEVA_OUT_OF_RANGE (-9)      /* beyond a limit of the device */
#define TACEVA_INTERRUPTED (-10)      /* `interrupt` or `halt` ended the call */
#define TACEVA_DEVICE_FAULT (-11)     /* the device reports a fault, or a number that is not finite */
#define TACEVA_ABI (-12)              /* the interfaces of the two sides do not match */
#define TACEVA_END_OF_STREAM (-13)    /* no more data will come */
#define TACEVA_PANICKED (-14)         /* a bug of the plugin, caught; the handle is dead */
#define TACEVA_INTERNAL (-15)         /* a detected bug */

/* ---- text and errors ---- */

typedef struct taceva_text {
  const char *data;
  size_t length;
} taceva_text;

#define TACEVA_MESSAGE_SIZE 504

/* Fault for which a device stopped by itself. Nothing moves after it until a person has looked. An unlisted number with the same upper 16 bits
 * counts as SERVO. No text begins with these bits, so a message of an old plugin that overran into this field is no fault. */
typedef uint32_t taceva_fault;

#define TACEVA_FAULT_NONE 0u
#define TACEVA_FAULT_EMERGENCY_STOP 0xfa170001u /* an emergency stop was pressed, or a safety guard opened */
#define TACEVA_FAULT_COLLISION 0xfa170002u      /* the device struck something */
#define TACEVA_FAULT_BOUNDARY 0xfa170003u       /* the device reached the limit of its workspace */
#define TACEVA_FAULT_SERVO 0xfa170004u          /* a servo, a brake or the controller failed */

/* Memory of the caller. A plugin writes at most `size` bytes. Hosts of minor version 0 have TACEVA_ERROR_SIZE bytes, without `fault`. */
#define TACEVA_ERROR_SIZE 512
typedef struct taceva_error {
  uint32_t size;                     /* in: size of this struct, bytes */
  int32_t vendor_code;               /* out: error number of the device, 0 for none */
  char message[TACEVA_MESSAGE_SIZE]; /* out: UTF-8 with a final NUL, truncated if it does not fit */
  taceva_fault fault;                /* out, since minor 1: written only if `size` covers it */
} taceva_error;

/* Callback that receives the texts that a function lists or writes. `text` is borrowed for the call. */
typedef void (*taceva_take_text)(void *context, taceva_text text);

/* ---- arguments, checked by the host against the manifest ---- */

#define TACEVA_ARG_TEXT 1u
#define TACEVA_ARG_WHOLE 2u
#define TACEVA_ARG_NUMBER 3u
#define TACEVA_ARG_FLAG 4u

typedef struct taceva_arg {
  taceva_text key;
  taceva_text text; /* value as text, for every type */
  int64_t whole;    /* value of a whole number; 0 or 1 for a flag */
  double number;    /* value of a number, in the unit that the manifest declares */
  uint32_t kind;    /* TACEVA_ARG_... */
  uint32_t reserved;
} taceva_arg;

typedef struct taceva_args {
  const taceva_arg *items;
  size_t count;
} taceva_args;

/* ---- services of the host; the table outlives all objects of a plugin ---- */

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

/* ---- time of an observation, and of its reception, in ns; for a real device by the clock of `now_ns` ---- */

typedef struct taceva_stamp {
  uint64_t valid_ns;
  uint64_t received_ns; /* 0: unknown */
} taceva_stamp;

/* ---- devices ---- */

/* Devices that are opened together. A plugin stores their shared objects here, such as one connection. */
typedef struct taceva_rig taceva_rig;

/* Calls that every device has. The table of each kind begins with them. Frozen: it never grows. */
typedef struct taceva_device_calls {
  uint32_t size; /* size of the whole table of the kind, bytes */
  uint32_t reserved;
  void (*close)(void *handle);                              /* [owner & open] stops the device and frees it; the last call */
  void (*interrupt)(void *handle);                          /* [any & open] a blocked call returns INTERRUPTED within 50 ms; no effect without one */
  const void *(*extension)(void *handle, taceva_text id);   /* [owner & open] a table of calls on `handle`, or NULL; may be NULL */
} taceva_device_calls;

/* An open device, filled in by `open`. */
typedef struct taceva_device {
  void *handle;
  const taceva_device_calls *calls; /* table of its kind; lives as long as the library */
} taceva_device;

/* Drivers of one kind, numbered from 0. */
typedef struct taceva_factory {
  uint32_t size;
  uint32_t drivers; /* number of drivers */

  /* [any] Writes the `[[provides]]` table of the manifest as TOML, without that header and with `[[args]]` in place of `[[provides.args]]`.
   * `args` has every argument that is given or has a default; NULL requests the description for any arguments. Accesses no device. */
  taceva_status (*describe)(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error);

  /* [any] Lists the connected devices, each as one text with the arguments that select it: "key=value;key=value". May be NULL. */
  taceva_status (*discover)(uint32_t driver, taceva_take_text take, void *context, taceva_error *error);

  /* [any] Opens a device; nothing moves and no light changes. `rig` is NULL if the plugin has none. */
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

  /* [any] Returns a `taceva_factory` for "taceva.sensor/1", "taceva.robot/1", "taceva.force/2", "taceva.lighting/1" or, since minor 2,
   * "taceva.changer/1". Returns a `taceva_estimator_factory` for "taceva.estimator/1", and NULL for a kind that the plugin lacks. */
  const void *(*factory)(taceva_text id);

  /* Shared objects of the devices in a rig. All three may be NULL. */
  taceva_status (*open_rig)(taceva_rig **rig, taceva_error *error);      /* [any] */
  void (*close_rig)(taceva_rig *rig);                                    /* [owner] after the last device of the rig */
  const void *(*rig_extension)(taceva_rig *rig, taceva_text id);         /* [owner] a table of calls on the rig, or NULL */

  /* Since minor 1: outside needs, one need of the manifest per line: "usb\ntcp:{host}:{port}". Empty: not stated. Only `taceva plugin manifest`
   * reads this field. A plugin gets the needs that its manifest declares and the user allows. */
  taceva_text needs;
} taceva_plugin;

#define TACEVA_SENSOR_FACTORY "taceva.sensor/1"
#define TACEVA_ROBOT_FACTORY "taceva.robot/1"
#define TACEVA_FORCE_FACTORY "taceva.force/2" /* since minor 3: torques in N mm */
#define TACEVA_LIGHTING_FACTORY "taceva.lighting/1"
#define TACEVA_CHANGER_FACTORY "taceva.changer/1"
#define TACEVA_ESTIMATOR_FACTORY "taceva.estimator/1"

/* The exported symbol:  TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1; */

#ifdef __cplusplus
}
#endif
#endif
