#!/bin/sh
# Digests of every flight here and in WebAssembly, and whether they are the same.
set -e
cd "$(dirname "$0")"
target=${CARGO_TARGET_DIR:-target}
cargo build --locked --release --bin here
cargo build --locked --release --lib --target wasm32-unknown-unknown
"$target/release/here" | tee "$target/here.txt"
node wasm.mjs "$target/wasm32-unknown-unknown/release/heliotorque_platforms.wasm" | tee "$target/wasm.txt"
cmp "$target/here.txt" "$target/wasm.txt" && echo "the same bits"
