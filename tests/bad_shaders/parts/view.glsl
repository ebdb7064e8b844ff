// A correct part, for those that misspell its name.
float near() { return 0.1; }
