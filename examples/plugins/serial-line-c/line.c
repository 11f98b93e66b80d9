/* A force transducer on a serial port. It sends its load in N, one line for each reading. A thread receives all lines and keeps the newest reading with
 * its time of arrival. `read` waits for a reading that it has not returned yet, until its deadline or an interrupt. */
#define _DEFAULT_SOURCE /* cfmakeraw, TIOCEXCL */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <taceva/force.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#define SPEED B115200
#define LONGEST_LINE 64
#define MOST_DAMAGED 10
#define LOOKING_MS 50           /* the thread looks this often whether the device is being closed */
#define OLD_NS 100000000u       /* lines that waited in the port or its adapter come within this time */

static const taceva_host *host; /* the argument of `init` */

static uint64_t now_ns(void) { return host->now_ns(host->context); }

typedef struct {
  int port;
  uint64_t opened_ns;
  pthread_t listener;
  pthread_mutex_t lock; /* of the fields below */
  pthread_cond_t bell;
  int is_closing, is_started, is_pending, is_interrupted;
  uint64_t came, seen; /* number of readings that came, and of the last one that was returned */
  double load_n;
  uint64_t came_ns;
  taceva_status ended; /* reason why no reading comes any more, with its words; TACEVA_OK while the port works */
  const char *why;
} transducer;

static taceva_status failed(taceva_error *error, taceva_status status, const char *why) {
  const size_t head = offsetof(taceva_error, message);
  if (error && error->size > head) {
    size_t room = error->size - head;
    snprintf(error->message, room < TACEVA_MESSAGE_SIZE ? room : TACEVA_MESSAGE_SIZE, "%s", why);
  }
  return status;
}

/* ---- the thread that receives ---- */

static void *ended(transducer *it, taceva_status status, const char *why) {
  pthread_mutex_lock(&it->lock);
  it->ended = status, it->why = why;
  pthread_cond_signal(&it->bell);
  pthread_mutex_unlock(&it->lock);
  return NULL;
}

static void deliver(transducer *it, double load_n, uint64_t came_ns) {
  if (came_ns < it->opened_ns + OLD_NS) return;
  pthread_mutex_lock(&it->lock);
  it->load_n = load_n, it->came_ns = came_ns, it->came += 1;
  pthread_cond_signal(&it->bell);
  pthread_mutex_unlock(&it->lock);
}

/* Reads a line without its line feed. Bytes from outside: only a finite number is a load. */
static int parse(const char *line, double *load_n) {
  char *end = NULL;
  *load_n = strtod(line, &end);
  return end != line && (*end == 0 || strcmp(end, "\r") == 0) && isfinite(*load_n);
}

static void *listen_to_port(void *handle) {
  transducer *it = handle;
  char line[LONGEST_LINE + 1];
  size_t length = 0;
  int damaged = 0, is_whole = 0; /* the first line began before the port was opened */
  for (;;) {
    struct pollfd ready = {it->port, POLLIN, 0};
    char bytes[256];
    double load_n = 0, newest_n = 0;
    int is_new = 0;
    pthread_mutex_lock(&it->lock);
    int is_closing = it->is_closing;
    pthread_mutex_unlock(&it->lock);
    if (is_closing) return NULL;
    if (poll(&ready, 1, LOOKING_MS) <= 0) continue;
    ssize_t count = read(it->port, bytes, sizeof bytes);
    uint64_t came_ns = now_ns();
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) return ended(it, TACEVA_DISCONNECTED, "the serial port is gone");
    for (ssize_t at = 0; at < count; at++) {
      if (bytes[at] != '\n') {
        /* A line that is too long keeps its length, and is damaged at its end. */
        if (length < LONGEST_LINE) line[length] = bytes[at];
        if (++length > 64 * LONGEST_LINE) return ended(it, TACEVA_PROTOCOL, "4096 bytes without a line feed, expected a line for each reading");
        continue;
      }
      line[length < LONGEST_LINE ? length : LONGEST_LINE] = 0;
      if (is_whole && length <= LONGEST_LINE && parse(line, &load_n)) {
        damaged = 0, is_new = 1, newest_n = load_n;
      } else if (is_whole && ++damaged == MOST_DAMAGED) {
        return ended(it, TACEVA_PROTOCOL, "10 lines in a row are no number, expected a load in N; check the speed of the port");
      }
      is_whole = 1, length = 0;
    }
    /* Lines that came together have one time of arrival, so only the last one is a reading. */
    if (is_new) deliver(it, newest_n, came_ns);
  }
}

/* ---- the calls of the host ---- */

static void close_line(void *handle) {
  transducer *it = handle;
  pthread_mutex_lock(&it->lock);
  it->is_closing = 1;
  pthread_mutex_unlock(&it->lock);
  pthread_join(it->listener, NULL);
  ioctl(it->port, TIOCNXCL);
  close(it->port);
  pthread_cond_destroy(&it->bell);
  pthread_mutex_destroy(&it->lock);
  free(it);
}

/* Interrupts the pending call, from any thread. Without one, it has no effect, not even on the next call. */
static void interrupt_line(void *handle) {
  transducer *it = handle;
  pthread_mutex_lock(&it->lock);
  if (it->is_pending) it->is_interrupted = 1;
  pthread_cond_signal(&it->bell);
  pthread_mutex_unlock(&it->lock);
}

static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) {
  transducer *it = handle;
  (void)timeout_ns, (void)error;
  pthread_mutex_lock(&it->lock);
  if (!it->is_started) it->seen = it->came; /* earlier readings are old */
  it->is_started = 1;
  pthread_mutex_unlock(&it->lock);
  return TACEVA_OK;
}

static taceva_status stop(void *handle, taceva_error *error) {
  transducer *it = handle;
  (void)error;
  pthread_mutex_lock(&it->lock);
  it->is_started = 0;
  pthread_mutex_unlock(&it->lock);
  return TACEVA_OK;
}

static taceva_status read_line(void *handle, taceva_wrench *wrench, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  transducer *it = handle;
  uint64_t begun_ns = now_ns(), until_ns = timeout_ns < UINT64_MAX - begun_ns ? begun_ns + timeout_ns : UINT64_MAX;
  struct timespec until = {(time_t)(until_ns / 1000000000u), (long)(until_ns % 1000000000u)};
  taceva_status status = TACEVA_OK;
  const char *why = "";
  if (!wrench || !stamp) return failed(error, TACEVA_INVALID_ARGUMENT, "`wrench` or `stamp` is NULL");
  pthread_mutex_lock(&it->lock);
  it->is_pending = 1;
  while (it->is_started && it->came == it->seen && it->ended == TACEVA_OK && !it->is_interrupted && now_ns() < until_ns)
    pthread_cond_timedwait(&it->bell, &it->lock, &until);
  if (!it->is_started) {
    status = TACEVA_INVALID_ARGUMENT, why = "it is not started";
  } else if (it->is_interrupted) {
    status = TACEVA_INTERRUPTED, why = "it was interrupted";
  } else if (it->came != it->seen) {
    memset(wrench, 0, sizeof *wrench);
    wrench->force_n[2] = it->load_n;
    stamp->valid_ns = stamp->received_ns = it->came_ns;
    it->seen = it->came;
  } else if (it->ended != TACEVA_OK) {
    status = it->ended, why = it->why;
  } else {
    status = TACEVA_TIMEOUT, why = "no line came in time";
  }
  it->is_pending = it->is_interrupted = 0;
  pthread_mutex_unlock(&it->lock);
  return status == TACEVA_OK ? status : failed(error, status, why);
}

static const taceva_force_calls calls = {{sizeof calls, 0, close_line, interrupt_line, NULL}, start, read_line, stop, NULL};

/* ---- opening ---- */

/* Opens the port for bytes as they are: without echo, line editing, or conversion of line feeds. Returns -1 and sets `errno` if this fails. */
static int open_port(const char *path) {
  struct termios line;
  /* Without O_NONBLOCK, a port without a carrier signal would block. */
  int port = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (port < 0) return -1;
  if (tcgetattr(port, &line) == 0) {
    cfmakeraw(&line);
    line.c_cflag |= CLOCAL | CREAD;
    /* Exclusive: another program would take some of the lines. */
    if (cfsetspeed(&line, SPEED) == 0 && tcsetattr(port, TCSANOW, &line) == 0 && ioctl(port, TIOCEXCL) == 0 &&
        tcflush(port, TCIFLUSH) == 0)
      return port;
  }
  int reason = errno;
  close(port);
  errno = reason;
  return -1;
}

static taceva_status open_line(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  char path[256] = "", why[320];
  (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one transducer");
  for (size_t at = 0; args && at < args->count; at++) {
    taceva_text text = args->items[at].text;
    if (text.length < sizeof path) snprintf(path, sizeof path, "%.*s", (int)text.length, text.data ? text.data : "");
  }
  int port = open_port(path);
  if (port < 0) {
    int reason = errno;
    snprintf(why, sizeof why, "%s: %s", path, strerror(reason));
    return failed(error, reason == EBUSY ? TACEVA_BUSY : reason == EACCES ? TACEVA_PERMISSION_DENIED : TACEVA_NOT_FOUND, why);
  }
  transducer *it = calloc(1, sizeof *it);
  if (!it) return close(port), failed(error, TACEVA_INTERNAL, "no memory");
  it->port = port;
  it->opened_ns = now_ns();
  pthread_condattr_t monotonic;
  pthread_condattr_init(&monotonic);
  pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC); /* the clock of `now_ns` */
  pthread_mutex_init(&it->lock, NULL);
  pthread_cond_init(&it->bell, &monotonic);
  pthread_condattr_destroy(&monotonic);
  if (pthread_create(&it->listener, NULL, listen_to_port, it) != 0)
    return close(port), free(it), failed(error, TACEVA_INTERNAL, "no thread can be started");
  device->handle = it;
  device->calls = &calls.device;
  return TACEVA_OK;
}

/* ---- the plugin ---- */

static const char TABLE[] =
    "kind = \"force\"\nkey = \"line\"\ntitle = \"load cell on a serial port\"\nsource = \"real\"\naxes = [\"Fz\"]\n"
    "rate_hz = 100\nnoise_N = 0.01\nresolution_N = 0.001\n"
    "[[args]]\nkey = \"port\"\ntype = \"path\"\nhelp = \"such as /dev/ttyUSB0\"\n";

static taceva_status describe(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error) {
  taceva_text text = {TABLE, sizeof TABLE - 1};
  (void)args;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one transducer");
  take(context, text);
  return TACEVA_OK;
}

static const taceva_factory forces = {sizeof forces, 1, describe, NULL, open_line};

static const void *factory(taceva_text id) {
  const char *force = TACEVA_FORCE_FACTORY;
  return id.length == strlen(force) && !memcmp(id.data, force, id.length) ? &forces : NULL;
}

static taceva_status init(const taceva_host *given, taceva_error *error) {
  (void)error;
  host = given;
  return TACEVA_OK;
}

TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1;
const taceva_plugin taceva_plugin_v1 = {
    TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR,
    {"org.example.serial-line-c", 25}, {"0.1.0", 5}, init, NULL, factory, NULL, NULL, NULL, {"serial:{port}", 13},
};
