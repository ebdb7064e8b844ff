// A fork server, preloaded into weft by tests that start it many times: what each start repeats (loading and relocating libraries, of which
// WEFT_FORK_SERVER_LOADS names one that is loaded later) is done once, and each command runs in a fork, from before the program's own
// constructors on. Of the socket WEFT_FORK_SERVER it takes messages of words with a 0 behind each: how many arguments, the folder, these
// arguments, the environment; standard input, output and error come with them. It answers with the wait status.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { kBytes = 1 << 18, kWords = 4096 };

typedef int (*Main)(int, char**, char**);
typedef int (*Start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);

// The words of the next message, and its files; 0 when there is none any more.
static size_t take(int client, char* text, char** words, int* files) {
  char control[CMSG_SPACE(3 * sizeof(int))];
  struct iovec part = {text, kBytes};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
  const ssize_t bytes = recvmsg(client, &message, 0);
  if (bytes <= 0) return 0;
  memcpy(files, CMSG_DATA(CMSG_FIRSTHDR(&message)), 3 * sizeof(int));
  size_t count = 0;
  for (char* at = text; at < text + bytes && count < kWords; at += strlen(at) + 1) words[count++] = at;
  return count;
}

// Returns in the process that is to run a command: its arguments, behind which the environment lies as behind those of any process.
static int serve(int client, char** argv) {
  static char text[kBytes];
  static char* words[kWords];
  int files[3], status;
  for (size_t count; (count = take(client, text, words, files)) > 0;) {
    const pid_t process = fork();
    if (process == 0) {
      close(client);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (int i = 0; i < 3; ++i) dup2(files[i], i), close(files[i]);
      if (chdir(words[1]) != 0) _exit(127);
      const int arguments = atoi(words[0]);
      memcpy(argv, words + 2, arguments * sizeof *argv);
      environ = argv + arguments + 1;
      memcpy(environ, words + 2 + arguments, (count - 2 - arguments) * sizeof *argv);
      return arguments;
    }
    for (int i = 0; i < 3; ++i) close(files[i]);
    if (waitpid(process, &status, 0) < 0 || write(client, &status, sizeof status) < 0) break;
  }
  _exit(0);
}

int __libc_start_main(Main program, int argc, char** argv, void (*init)(void), void (*fini)(void), void (*ended)(void), void* stack) {
  static char* given[kWords + 2];
  if (getenv("WEFT_FORK_SERVER")) {
    dlopen(getenv("WEFT_FORK_SERVER_LOADS"), RTLD_NOW | RTLD_LOCAL);
    argc = serve(atoi(getenv("WEFT_FORK_SERVER")), argv = given);
  }
  return ((Start)dlsym(RTLD_NEXT, "__libc_start_main"))(program, argc, argv, init, fini, ended, stack);
}
