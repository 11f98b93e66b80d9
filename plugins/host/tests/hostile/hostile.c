/* A plugin that misbehaves in the way that the macro WAY names: `cc -shared -fPIC -DWAY='"capture_segv"'`.
 *
 * Otherwise it is a valid plugin with a sensor, a robot and a force transducer. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <locale.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "taceva/ext/tare.h"
#include "taceva/force.h"
#include "taceva/robot.h"
#include "taceva/sensor.h"

#ifndef WAY
#define WAY "good"
#endif

#define WIDTH 64
#define HEIGHT 48
#define LENGTH (WIDTH * HEIGHT * 3)

#include "tables.h" /* SENSOR_TABLE, ROBOT_TABLE and FORCE_TABLE, as in the manifest */

static int is(const char *way) { return strcmp(WAY, way) == 0; }

static taceva_text text(const char *data) {
  taceva_text text = {data, strlen(data)};
  return text;
}

static taceva_status fail(taceva_error *error, taceva_status status, const char *message) {
  snprintf(error->message, TACEVA_MESSAGE_SIZE, "%s", message);
  return status;
}

static void hang(void) {
  for (;;) pause();
}

/* Hides the bad address from the compiler. */
static void *volatile nowhere = (void *)8;
static void segv(void) { *(volatile char *)nowhere = 1; }

/* ---- code that runs outside calls ---- */

static void at_exit(void) {
  if (is("atexit_hang")) hang();
  if (is("atexit_abort")) abort();
}

__attribute__((constructor)) static void constructor(void) {
  if (is("constructor_segv")) segv();
  if (is("constructor_exit")) exit(0);
  if (is("constructor_abort")) abort();
  if (is("constructor_hang")) hang();
  if (is("constructor_closes_files"))
    for (int file = 0; file < 1024; file++) close(file);
  atexit(at_exit);
}

__attribute__((destructor)) static void destructor(void) {
  if (is("destructor_segv")) segv();
  if (is("destructor_hang")) hang();
}

static void *for_ever(void *context) {
  (void)context;
  for (volatile uint64_t count = 0;; count++)
    if (count % 1000000 == 0) sched_yield();
  return NULL;
}

static void *scribble(void *context) {
  for (;;) memset(context, rand(), LENGTH);
  return NULL;
}

static void *idle(void *context) {
  (void)context;
  hang();
  return NULL;
}

static pthread_key_t key;
static void key_gone(void *value) {
  (void)value;
  abort();
}

/* ---- the sensor ---- */

static jmp_buf landing;
static uint64_t frames;
static int endless(volatile int *depth) {
  volatile char frame[4096];
  frame[0] = (char)*depth;
  (*depth)++;
  return endless(depth) + frame[0];
}

static void nothing(int signal) { (void)signal; }

static void release_twice(taceva_frame *frame) {
  free(frame->private_data);
  free(frame->private_data);
  frame->release = NULL;
}
static void release_crash(taceva_frame *frame) {
  (void)frame;
  segv();
}
static void release_hang(taceva_frame *frame) {
  (void)frame;
  hang();
}
static void release_nothing(taceva_frame *frame) { frame->release = NULL; }
static void release_free(taceva_frame *frame) {
  free(frame->private_data);
  frame->private_data = NULL;
  frame->release = NULL;
}

static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns, (void)error;
  if (is("start_hang")) hang();
  return TACEVA_OK;
}

static taceva_status stop(void *handle, taceva_error *error) {
  (void)handle, (void)error;
  if (is("stop_hang")) hang();
  return TACEVA_OK;
}

#include "escapes.h" /* void escapes(uint8_t *into): one byte per attempt, 1 for success */

static taceva_status capture(void *handle, taceva_frame *frame, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  uint64_t now_ns = (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
  frames++;
  frame->format = TACEVA_RGB8;
  frame->width = WIDTH;
  frame->height = HEIGHT;
  frame->sequence = frames;
  frame->stamp.valid_ns = now_ns;
  frame->stamp.received_ns = now_ns;
  frame->data = frame->buffer;
  frame->length = LENGTH;
  if (frame->buffer) memset(frame->buffer, (int)frames, LENGTH);

  if (is("capture_segv")) segv();
  if (is("capture_abort")) abort();
  if (is("capture_exit")) exit(0);
  if (is("capture_exit_now")) _exit(7);
  if (is("capture_hang")) hang();
  if (is("capture_spin")) for_ever(NULL);
  if (is("capture_longjmp")) longjmp(landing, 1);
  if (is("capture_stack_overflow")) {
    volatile int depth = 0;
    endless(&depth);
  }
  if (is("capture_kills_itself")) kill(getpid(), SIGKILL);
  if (is("capture_divides")) {
    volatile int zero = 0;
    zero = 7 / zero;
  }
  if (is("signal_games")) {
    sigset_t all;
    sigfillset(&all);
    for (int signal_number = 1; signal_number < 65; signal_number++) signal(signal_number, nothing);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
    hang();
  }
  if (is("closes_files"))
    for (int file = 0; file < 1024; file++) close(file);
  if (is("garbage_on_files")) {
    char garbage[512];
    memset(garbage, 0xA5, sizeof garbage);
    for (int file = 3; file < 64; file++) send(file, garbage, sizeof garbage, MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  if (is("early_answers")) {
    /* Unrequested answer with a likely call number, on every socket. */
    char answer[] = {3, 0, 0, 0, 0};
    for (int file = 3; file < 64; file++) send(file, answer, sizeof answer, MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  if (is("leaks_files")) {
    int opened = 0;
    while (open("/dev/null", O_RDONLY) >= 0 && opened < 100000) opened++;
    if (opened >= 100000) return fail(error, TACEVA_INTERNAL, "there is no limit of files");
  }
  if (is("takes_memory")) {
    uint64_t taken = 0;
    for (char *block; taken < (10ull << 30) && (block = malloc(64 << 20)); taken += 64 << 20) memset(block, 1, 4096);
    if (taken >= (10ull << 30)) return fail(error, TACEVA_INTERNAL, "there is no limit of memory");
  }
  if (is("starts_threads")) {
    int started = 0;
    for (pthread_t thread; started < 100000 && pthread_create(&thread, NULL, idle, NULL) == 0; started++) {}
    if (started >= 100000) return fail(error, TACEVA_INTERNAL, "there is no limit of threads");
  }
  if (is("fork_bomb")) {
    int forked = 0;
    for (int attempt = 0; attempt < 100; attempt++) {
      long child = syscall(SYS_fork);
      if (child == 0) hang();
      forked += child > 0;
      if (fork() > 0) forked++;
    }
    if (forked) return fail(error, TACEVA_INTERNAL, "it forked");
  }
  if (is("fills_output")) {
    char line[1024];
    memset(line, 'x', sizeof line);
    for (int count = 0; count < 10000; count++) (void)!write(1, line, sizeof line);
  }
  if (is("floods_output")) {
    static char line[1 << 16];
    memset(line, 'x', sizeof line);
    for (;;) (void)!write(1, line, sizeof line);
  }
  if (is("prints")) printf("{\"this\": \"is not a report\"}\n"), fflush(stdout);
  if (is("prints_escapes")) {
    fprintf(stderr, "\033]52;c;aGVsbG8=\007\033[2J\033[31m the end\n");
    abort();
  }
  if (is("frame_longer")) frame->length = LENGTH * 2;
  if (is("frame_shorter")) frame->length = LENGTH / 2;
  if (is("frame_length_overflows")) frame->length = UINT64_MAX - 7, frame->width = UINT32_MAX, frame->height = UINT32_MAX;
  if (is("frame_other_size")) frame->width = WIDTH * 4, frame->height = HEIGHT / 4, frame->length = LENGTH;
  if (is("frame_unknown_format")) frame->format = 99;
  if (is("frame_null")) frame->data = NULL;
  if (is("frame_from_nowhere")) frame->data = (const uint8_t *)nowhere, frame->release = release_free, frame->private_data = NULL;
  if (is("frame_struct_smaller")) frame->size = 4;
  if (is("buffer_overrun") && frame->buffer) memset(frame->buffer, 1, LENGTH + (64 << 20));
  if (is("lent_released_twice") || is("lent_changed") || is("release_crash") || is("release_hang")) {
    static uint8_t kept[LENGTH];
    uint8_t *lent = is("lent_changed") ? kept : malloc(LENGTH);
    memset(lent, 9, LENGTH);
    frame->data = lent;
    frame->private_data = lent;
    frame->release = is("lent_released_twice") ? release_twice
                     : is("release_crash")     ? release_crash
                     : is("release_hang")      ? release_hang
                     : is("lent_changed")      ? release_nothing
                                               : release_free;
    pthread_t thread;
    if (is("lent_changed")) pthread_create(&thread, NULL, scribble, lent);
  }
  if (is("changes_after") && frames == 1) {
    /* Second mapping of the shared memory, because the host unmaps the first one after the sensor is closed. */
    void *kept = mremap(frame->buffer, 0, LENGTH, MREMAP_MAYMOVE);
    if (kept == MAP_FAILED) return fail(error, TACEVA_INTERNAL, "the buffer is no shared memory");
    pthread_t thread;
    pthread_create(&thread, NULL, scribble, kept);
  }
  if (is("writes_after_close") && frames == 1) {
    pthread_t thread;
    pthread_create(&thread, NULL, scribble, frame->buffer);
  }
  if (is("stamp_far_future")) frame->stamp.valid_ns = UINT64_MAX;
  if (is("status_unknown")) return -7777;
  if (is("status_positive")) return 5;
  if (is("message_endless")) {
    memset(error->message, 'm', TACEVA_MESSAGE_SIZE);
    return TACEVA_DEVICE_FAULT;
  }
  if (is("message_no_text")) {
    memset(error->message, 0xFF, 100);
    error->message[100] = 0;
    return TACEVA_DEVICE_FAULT;
  }
  if (is("message_escapes")) return fail(error, TACEVA_DEVICE_FAULT, "\033]0;owned\007\033[2J");
  if (is("error_overrun")) memset(error, 'e', 1 << 20);
  if (is("changes_the_process")) {
    if (chdir("/") || setenv("PATH", "/nowhere", 1) || !setlocale(LC_ALL, "C")) return fail(error, TACEVA_INTERNAL, "it could not");
  }
  if (is("thread_local_end")) {
    pthread_key_create(&key, key_gone);
    pthread_setspecific(key, &key);
  }
  if (is("threads_at_the_end")) {
    pthread_t thread;
    for (int count = 0; count < 8; count++) pthread_create(&thread, NULL, for_ever, NULL);
  }
  if (is("escapes")) escapes(frame->buffer);
  return TACEVA_OK;
}

static void close_device(void *handle) {
  (void)handle;
  if (is("close_segv")) segv();
  if (is("close_hang")) hang();
}

static void interrupt(void *handle) {
  (void)handle;
  if (is("interrupt_hang")) hang();
  if (is("interrupt_segv")) segv();
}

static taceva_status zero_load(void *handle, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns, (void)error;
  return TACEVA_OK;
}
static const taceva_tare_calls tare_calls = {sizeof(taceva_tare_calls), 0, zero_load};

static const void *extension(void *handle, taceva_text id) {
  (void)handle;
  if (is("extension_nowhere")) return nowhere;
  if (is("extension_misaligned")) return (const char *)&frames + 1;
  if (id.length == strlen(TACEVA_TARE) && !memcmp(id.data, TACEVA_TARE, id.length)) return &tare_calls;
  return NULL;
}

static const taceva_sensor_calls sensor_calls = {
    {sizeof(taceva_sensor_calls), 0, close_device, interrupt, extension}, 4, 0, start, capture, stop};
static const taceva_sensor_calls sensor_calls_without = {
    {sizeof(taceva_sensor_calls), 0, close_device, interrupt, NULL}, 0, 0, NULL, NULL, NULL};
static const taceva_sensor_calls sensor_calls_small = {{8, 0, close_device, interrupt, NULL}, 0, 0, start, capture, stop};

/* ---- the robot and the transducer ---- */

static taceva_status pose(void *handle, taceva_pose *pose, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns, (void)error;
  memset(pose, 0, sizeof *pose);
  pose->qw = is("pose_no_rotation") ? 0.0 : 1.0;
  if (is("pose_nan")) pose->x = 0.0 / 0.0;
  stamp->valid_ns = stamp->received_ns = 1;
  return TACEVA_OK;
}
static taceva_status move_to(void *handle, const taceva_motion *motion, uint64_t *token, taceva_error *error) {
  (void)handle, (void)motion, (void)error;
  *token = 1;
  return TACEVA_OK;
}
static volatile int halted;
static taceva_status wait_for(void *handle, uint64_t token, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)token, (void)timeout_ns;
  stamp->valid_ns = stamp->received_ns = 1;
  while (is("robot_never_arrives") || is("robot_ignores_halts")) {
    usleep(1000);
    if (halted && is("robot_never_arrives")) return fail(error, TACEVA_INTERRUPTED, "halted");
  }
  return TACEVA_OK;
}
static taceva_status halt(void *handle, taceva_error *error) {
  (void)handle, (void)error;
  if (is("halt_hang")) hang();
  halted = 1;
  return TACEVA_OK;
}
static taceva_status clear_halt(void *handle, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns, (void)error;
  halted = 0;
  return TACEVA_OK;
}
static const taceva_robot_calls robot_calls = {
    {sizeof(taceva_robot_calls), 0, close_device, interrupt, NULL}, pose, move_to, wait_for, halt, clear_halt};

static taceva_status read_force(void *handle, taceva_wrench *wrench, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)timeout_ns, (void)error;
  memset(wrench, 0, sizeof *wrench);
  wrench->force_n[2] = 1.5;
  if (is("wrench_nan")) wrench->force_n[2] = 0.0 / 0.0;
  if (is("wrench_infinite")) wrench->torque_n_mm[1] = 1.0 / 0.0;
  stamp->valid_ns = stamp->received_ns = is("stamp_stale") ? 0 : 5;
  return TACEVA_OK;
}
static const taceva_force_calls force_calls = {{sizeof(taceva_force_calls), 0, close_device, interrupt, extension}, start, read_force, stop, NULL};

/* ---- factories ---- */

static taceva_status describe_as(const char *table, taceva_take_text take, void *context) {
  if (is("describe_hang")) hang();
  if (is("describe_segv")) segv();
  if (is("describe_null")) {
    taceva_text none = {NULL, 10};
    take(context, none);
  } else if (is("describe_no_text")) {
    take(context, text("\xFF\xFE"));
  } else if (is("describe_endless")) {
    for (;;) take(context, text(table));
  } else if (is("describe_length_overflows")) {
    taceva_text huge = {table, SIZE_MAX - 3};
    take(context, huge);
  } else if (is("describe_lies")) {
    take(context, text("kind = \"sensor\"\nkey = \"sensor\"\ntitle = \"another\"\nsource = \"real\"\n"));
  } else {
    take(context, text(table));
  }
  return TACEVA_OK;
}

#define DESCRIBE(name, table)                                                                                          \
  static taceva_status name(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context,            \
                            taceva_error *error) {                                                                     \
    (void)driver, (void)args, (void)error;                                                                             \
    return describe_as(table, take, context);                                                                          \
  }
DESCRIBE(describe_sensor, SENSOR_TABLE)
DESCRIBE(describe_robot, ROBOT_TABLE)
DESCRIBE(describe_force, FORCE_TABLE)

static taceva_status open_as(const void *calls, taceva_device *device) {
  static int state;
  device->handle = &state;
  device->calls = (const taceva_device_calls *)calls;
  if (is("open_segv")) segv();
  if (is("open_hang")) hang();
  if (is("open_exit")) exit(0);
  if (is("open_no_calls")) device->calls = NULL;
  if (is("open_calls_nowhere")) device->calls = (const taceva_device_calls *)nowhere;
  if (is("open_calls_misaligned")) device->calls = (const taceva_device_calls *)((const char *)calls + 1);
  if (is("open_calls_small")) device->calls = &sensor_calls_small.device;
  if (is("open_calls_null")) device->calls = &sensor_calls_without.device;
  if (setjmp(landing)) abort();
  return TACEVA_OK;
}

#define OPEN(name, calls)                                                                                              \
  static taceva_status name(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device,          \
                            taceva_error *error) {                                                                     \
    (void)driver, (void)args, (void)rig, (void)error;                                                                  \
    return open_as(calls, device);                                                                                     \
  }
OPEN(open_sensor, &sensor_calls)
OPEN(open_robot, &robot_calls)
OPEN(open_force, &force_calls)

static const taceva_factory sensors = {sizeof(taceva_factory), 1, describe_sensor, NULL, open_sensor};
static const taceva_factory robots = {sizeof(taceva_factory), 1, describe_robot, NULL, open_robot};
static const taceva_factory forces = {sizeof(taceva_factory), 1, describe_force, NULL, open_force};

static const void *factory(taceva_text id) {
  if (is("factory_segv")) segv();
  if (is("factory_nowhere")) return nowhere;
  if (is("factory_null")) return NULL;
  if (id.length == strlen(TACEVA_SENSOR_FACTORY) && !memcmp(id.data, TACEVA_SENSOR_FACTORY, id.length)) return &sensors;
  if (id.length == strlen(TACEVA_ROBOT_FACTORY) && !memcmp(id.data, TACEVA_ROBOT_FACTORY, id.length)) return &robots;
  if (id.length == strlen(TACEVA_FORCE_FACTORY) && !memcmp(id.data, TACEVA_FORCE_FACTORY, id.length)) return &forces;
  return NULL;
}

static taceva_status init(const taceva_host *host, taceva_error *error) {
  (void)host;
  if (is("init_fails")) return fail(error, TACEVA_DEVICE_FAULT, "no licence was found");
  if (is("init_segv")) segv();
  if (is("init_hang")) hang();
  if (is("init_throws_away")) memset((void *)(uintptr_t)host, 0, sizeof *host);
  return TACEVA_OK;
}

static void deinit(void) {
  if (is("deinit_segv")) segv();
  if (is("deinit_hang")) hang();
}

#define CONSTANT(words) words, sizeof(words) - 1

#ifndef NO_SYMBOL
#ifdef MAGIC_ONLY
TACEVA_EXPORT const uint32_t taceva_plugin_v1 = TACEVA_MAGIC;
#else
TACEVA_EXPORT const taceva_plugin taceva_plugin_v1 = {
#ifdef WRONG_MAGIC
    0x12345678,
#else
    TACEVA_MAGIC,
#endif
#ifdef SMALL
    24,
#else
    sizeof(taceva_plugin),
#endif
#ifdef NEWER
    TACEVA_ABI_MAJOR + 1,
#else
    TACEVA_ABI_MAJOR,
#endif
    TACEVA_ABI_MINOR,
#ifdef OTHER_ID
    {CONSTANT("org.example.other")},
#else
    {CONSTANT("org.example.hostile")},
#endif
#ifdef ID_NOWHERE
    {(const char *)16, 5},
#else
    {CONSTANT("1.0.0")},
#endif
    init, deinit, factory, NULL, NULL, NULL, {NULL, 0}};
#endif
#endif
