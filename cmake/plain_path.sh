# For bash, to be read by `.`: plain_path FOLDER prints a path to FOLDER that every tool of the build can take. A quote, a backslash or a
# semicolon in a path makes CMake and Ninja rebuild everything each time, install nothing or give up, and a space ends a path
# in the options of sanitizers. Such a folder is reached by a symbolic link in /tmp; its name follows from the path, so that a build finds it
# again, and it is made anew when /tmp was emptied.
plain_path() {
  local folder=$1 link
  if [[ $folder != *[!A-Za-z0-9/._+,=@%-]* ]]; then
    printf '%s\n' "$folder"
    return
  fi
  link="/tmp/weft_$(id -u)_$(printf %s "$folder" | cksum | tr ' ' _)"
  [ -L "$link" ] || ln -s "$folder" "$link" || return
  if [ "$(readlink "$link")" != "$folder" ] || [ "$(stat -c %u "$link")" != "$(id -u)" ]; then
    echo "run: $link is to be your link to $folder and is something else; remove it" >&2
    return 1
  fi
  printf '%s\n' "$link"
}

# plain_build_path TOP BUILD: the same for a build folder, by way of the link to TOP where it lies in there.
plain_build_path() {
  local top
  case $2 in
    "$1"/*) top=$(plain_path "$1") && plain_path "$top${2#"$1"}" ;;
    *) plain_path "$2" ;;
  esac
}
