/* A lamp that opens only if it can access a resource outside its process. Its arguments select the resource. */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/netlink.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "taceva/lighting.h"

#define TEXT(literal) {literal, sizeof(literal) - 1}

static int is(taceva_text text, const char *word) { return text.length == strlen(word) && !memcmp(text.data, word, text.length); }

static const taceva_arg *argument(const taceva_args *args, const char *key) {
  for (size_t at = 0; at < args->count; at++)
    if (is(args->items[at].key, key)) return &args->items[at];
  return NULL;
}

static struct sockaddr_in local(long long port) {
  struct sockaddr_in address = {0};
  address.sin_family = AF_INET;
  address.sin_port = htons((uint16_t)port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/* 0, or the error number of the system. */
static int reached(int result) { return result < 0 ? errno : 0; }

static int reach(const char *way, const char *path, long long port) {
  struct sockaddr_in address = local(port);
  const struct sockaddr *to = (const struct sockaddr *)&address;
  int file = -1, why;
  if (!strcmp(way, "tcp") || !strcmp(way, "listen")) {
    file = socket(AF_INET, SOCK_STREAM, 0);
    if (file < 0) return errno;
    why = !strcmp(way, "tcp") ? reached(connect(file, to, sizeof address)) : reached(bind(file, to, sizeof address));
    if (!why && !strcmp(way, "listen")) why = reached(listen(file, 1));
  } else if (!strcmp(way, "udp")) {
    file = socket(AF_INET, SOCK_DGRAM, 0);
    if (file < 0) return errno;
    why = reached((int)sendto(file, "x", 1, 0, to, sizeof address));
  } else if (!strcmp(way, "usb")) { /* the socket for hotplug events, which libraries need */
    file = socket(AF_NETLINK, SOCK_RAW, NETLINK_KOBJECT_UEVENT);
    why = reached(file);
  } else if (!strcmp(way, "write")) {
    file = open(path, O_WRONLY | O_CLOEXEC);
    why = reached(file);
  } else if (!strcmp(way, "read")) {
    file = open(path, O_RDONLY | O_CLOEXEC);
    why = reached(file);
  } else {
    file = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    why = reached(file);
  }
  if (file >= 0) close(file);
  return why;
}

static void close_lamp(void *handle) { free(handle); }

static taceva_status set(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error) {
  (void)handle, (void)scene, (void)timeout_ns, (void)error;
  return TACEVA_OK;
}

static const taceva_lighting_calls calls = {{sizeof calls, 0, close_lamp, NULL, NULL}, set};

static taceva_status describe(uint32_t driver, const taceva_args *args, taceva_take_text take, void *context, taceva_error *error) {
  taceva_text text = TEXT("kind = \"lighting\"\nkey = \"lamp\"\ntitle = \"lamp\"\nsource = \"real\"\nscenes = [\"dark\"]\n"
                          "[[args]]\nkey = \"way\"\ntype = \"text\"\n[[args]]\nkey = \"path\"\ntype = \"path\"\noptional = true\n"
                          "[[args]]\nkey = \"port\"\ntype = \"whole\"\nrange = [1, 65535]\noptional = true\n");
  (void)args, (void)error;
  if (driver != 0) return TACEVA_NOT_FOUND;
  take(context, text);
  return TACEVA_OK;
}

static taceva_status open_lamp(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  const taceva_arg *way = argument(args, "way"), *path = argument(args, "path"), *port = argument(args, "port");
  char words[2][256] = {{0}};
  (void)driver, (void)rig;
  if (way && way->text.length < 256) memcpy(words[0], way->text.data, way->text.length);
  if (path && path->text.length < 256) memcpy(words[1], path->text.data, path->text.length);
  int why = reach(words[0], words[1], port ? port->whole : 0);
  if (why) {
    snprintf(error->message, TACEVA_MESSAGE_SIZE, "%s: %s (os error %d)", words[0], strerror(why), why);
    return why == EACCES || why == EPERM ? TACEVA_PERMISSION_DENIED : TACEVA_NOT_FOUND;
  }
  device->handle = malloc(1);
  device->calls = &calls.device;
  return TACEVA_OK;
}

static const taceva_factory lamps = {sizeof lamps, 1, describe, NULL, open_lamp};

static const void *factory(taceva_text id) { return is(id, TACEVA_LIGHTING_FACTORY) ? &lamps : NULL; }

TACEVA_EXPORT extern const taceva_plugin taceva_plugin_v1;
const taceva_plugin taceva_plugin_v1 = {
    TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR, TEXT("org.example.reach"), TEXT("1.0.0"),
    NULL, NULL, factory, NULL, NULL, NULL, {NULL, 0},
};
