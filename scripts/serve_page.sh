#!/usr/bin/env bash
# Builds a page and serves it on this machine. Usage: serve_page.sh studio|game [--port N]
set -euo pipefail
cd "$(dirname "$0")/.."
page=$1
shift
usage="usage: ./run $page [--port N]
Builds the page where something changed, and serves it on this machine until Ctrl C. Default port: 4173, or the next free one."
port=4173
strict=()
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h)
      echo "$usage"
      exit 0
      ;;
    --port)
      if ! [[ ${2:-} =~ ^[0-9]{1,5}$ ]] || [ "$2" -lt 1 ] || [ "$2" -gt 65535 ]; then
        echo "$page: --port needs a number from 1 to 65535" >&2
        exit 2
      fi
      port=$2
      strict=(--strictPort)
      shift 2
      ;;
    *)
      printf '%s: unknown argument %s\n%s\n' "$page" "$1" "$usage" >&2
      exit 2
      ;;
  esac
done

scripts/install.sh web
. scripts/node.sh
scripts/build_page.sh "$page"
echo "The $page, until Ctrl C:"
cd "web/$page"
exec npx vite preview --host 127.0.0.1 --port "$port" "${strict[@]}"
