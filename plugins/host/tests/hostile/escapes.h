/* Ways out of a sandbox, tried in sequence. The plugin and a program without a sandbox share them; they must succeed in the program. */
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#ifndef SECRET
#define SECRET "/etc/passwd"
#endif
#ifndef OUTSIDE
#define OUTSIDE P_tmpdir "/taceva-outside"
#endif
#ifndef PORT
#define PORT 9
#endif

static struct sockaddr_in local(int port) {
  struct sockaddr_in address;
  memset(&address, 0, sizeof address);
  address.sin_family = AF_INET;
  address.sin_port = htons((uint16_t)port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

static int reads_a_foreign_file(void) {
  char byte;
  int file = open(SECRET, O_RDONLY);
  int read_it = file >= 0 && read(file, &byte, 1) == 1;
  if (file >= 0) close(file);
  return read_it;
}

static int writes_outside(void) {
  int file = open(OUTSIDE, O_WRONLY | O_CREAT, 0600);
  int wrote = file >= 0 && write(file, "x", 1) == 1;
  if (file >= 0) close(file);
  return wrote;
}

static int connects_by_tcp(void) {
  struct sockaddr_in address = local(PORT);
  int socket_file = socket(AF_INET, SOCK_STREAM, 0);
  int connected = socket_file >= 0 && connect(socket_file, (struct sockaddr *)&address, sizeof address) == 0;
  if (socket_file >= 0) close(socket_file);
  return connected;
}

static int sends_by_udp(void) {
  struct sockaddr_in address = local(PORT);
  int socket_file = socket(AF_INET, SOCK_DGRAM, 0);
  int sent = socket_file >= 0 && sendto(socket_file, "x", 1, 0, (struct sockaddr *)&address, sizeof address) == 1;
  if (socket_file >= 0) close(socket_file);
  return sent;
}

static int binds_a_port(void) {
  struct sockaddr_in address = local(0);
  int socket_file = socket(AF_INET, SOCK_STREAM, 0);
  int bound = socket_file >= 0 && bind(socket_file, (struct sockaddr *)&address, sizeof address) == 0;
  if (socket_file >= 0) close(socket_file);
  return bound;
}

static int forks(void) {
  pid_t child = fork();
  if (child == 0) _exit(0);
  if (child > 0) waitpid(child, NULL, 0);
  return child > 0;
}

/* A started program could not report back, so its name is at an unreadable address. An allowed call fails with an error about the address,
 * and a denied call does not read it. */
static int starts_a_program(void) {
  long denied = syscall(SYS_execve, (const char *)8, NULL, NULL);
  return denied == -1 && errno == EFAULT;
}

static int signals_the_parent(void) { return kill(getppid(), SIGCONT) == 0 || kill(getppid(), 0) == 0; }

static int traces_the_parent(void) {
  if (syscall(SYS_ptrace, PTRACE_SEIZE, getppid(), 0, 0) != 0) return 0;
  syscall(SYS_ptrace, PTRACE_DETACH, getppid(), 0, 0);
  return 1;
}

static int opens_the_memory_of_the_parent(void) {
  char path[64];
  snprintf(path, sizeof path, "/proc/%d/mem", (int)getppid());
  int file = open(path, O_RDWR);
  if (file >= 0) close(file);
  return file >= 0;
}

static int reads_the_memory_of_the_parent(void) {
  char byte;
  struct iovec mine = {&byte, 1}, theirs = {(void *)starts_a_program, 1};
  /* The address need not be valid: the error shows whether the call was allowed. */
  return syscall(SYS_process_vm_readv, getppid(), &mine, 1, &theirs, 1, 0) == 1 || errno == EFAULT;
}

static int mounts(void) {
  if (mount("none", "/mnt", "tmpfs", 0, "") != 0) return 0;
  umount("/mnt");
  return 1;
}

static int makes_memory_executable(void) {
  char *page = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return 0;
  page[0] = 1;
  int made = mprotect(page, 4096, PROT_READ | PROT_EXEC) == 0;
  char *both = mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  munmap(page, 4096);
  return made || both != MAP_FAILED;
}

static int makes_a_file_to_execute(void) { return syscall(SYS_memfd_create, "code", 0u) >= 0; }

static int makes_a_namespace(void) { return unshare(CLONE_FS | CLONE_FILES) == 0; }

static int outlives_its_parent(void) {
  if (prctl(PR_SET_PDEATHSIG, 0) != 0) return 0;
  return 1;
}

static int shows_its_memory(void) { return prctl(PR_SET_DUMPABLE, 1) == 0; }

static int takes_files_of_the_parent(void) {
  long handle = syscall(SYS_pidfd_open, getppid(), 0);
  if (handle < 0) return 0;
  long taken = syscall(SYS_pidfd_getfd, (int)handle, 0, 0);
  close((int)handle);
  return taken >= 0;
}

static int (*const ESCAPES[])(void) = {
    reads_a_foreign_file,
    writes_outside,
    connects_by_tcp,
    sends_by_udp,
    binds_a_port,
    forks,
    starts_a_program,
    signals_the_parent,
    traces_the_parent,
    opens_the_memory_of_the_parent,
    reads_the_memory_of_the_parent,
    mounts,
    makes_memory_executable,
    makes_a_file_to_execute,
    makes_a_namespace,
    outlives_its_parent,
    shows_its_memory,
    takes_files_of_the_parent,
};
#define ESCAPE_COUNT (sizeof ESCAPES / sizeof *ESCAPES)

/* One byte per attempt: 1 for success, 0 for failure. 255 ends the list. */
static void escapes(uint8_t *into) {
  for (size_t at = 0; at < ESCAPE_COUNT; at++) into[at] = (uint8_t)ESCAPES[at]();
  into[ESCAPE_COUNT] = 255;
}

#ifdef ESCAPES_MAIN
int main(void) {
  uint8_t open_ones[ESCAPE_COUNT + 1];
  escapes(open_ones);
  return fwrite(open_ones, 1, ESCAPE_COUNT, stdout) == ESCAPE_COUNT ? 0 : 1;
}
#endif
