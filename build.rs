//! Tells the linker to keep what the bundler needs to split the page's module: see src/later.rs.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var_os("CARGO_CFG_TARGET_FAMILY").is_some_and(|family| family == "wasm") {
        println!("cargo:rustc-link-arg-bin=page=--emit-relocs");
    }
}
