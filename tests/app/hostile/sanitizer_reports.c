// What sanitizer_reports.py looks at: one mistake, named by the argument, and exit code 1 whatever it was. "death" is none of the program:
// LeakSanitizer cannot stop a process that another one traces, and dies.
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int count, char** words) {
  const char* mistake = count > 1 ? words[1] : "";
  if (strcmp(mistake, "death") == 0) {
    const pid_t traced = fork();
    int status = 0;
    if (traced > 0)
      _exit(waitpid(traced, &status, 0) == traced && WIFEXITED(status) ? WEXITSTATUS(status) : 2);
    if (traced < 0 || ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0) _exit(2);
  }
  char* volatile block = malloc(8);
  volatile int number = INT_MAX;
  if (strcmp(mistake, "block") == 0) block[8] = 1;
  if (strcmp(mistake, "number") == 0) number += 1;
  if (strcmp(mistake, "leak") != 0) free(block);
  block = NULL;
  return 1;
}
