// What sanitizer_reports.py looks at: one mistake, named by the argument, and exit code 1 whatever it was.
#include <limits.h>
#include <stdlib.h>
#include <string.h>

int main(int count, char** words) {
  const char* mistake = count > 1 ? words[1] : "";
  char* volatile block = malloc(8);
  volatile int number = INT_MAX;
  if (strcmp(mistake, "block") == 0) block[8] = 1;
  if (strcmp(mistake, "number") == 0) number += 1;
  if (strcmp(mistake, "leak") != 0) free(block);
  block = NULL;
  return 1;
}
