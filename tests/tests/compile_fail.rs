//! Programs that must not compile, and what the compiler tells about them.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// The newest build of the rasterizer among the libraries that this test was linked with.
fn rasterizer(libraries: &Path) -> PathBuf {
    let built = fs::read_dir(libraries).unwrap().map(|entry| entry.unwrap().path());
    let named = built.filter(|path| {
        let name = path.file_name().unwrap().to_string_lossy();
        name.starts_with("librasterizer-") && name.ends_with(".rlib")
    });
    named.max_by_key(|path| fs::metadata(path).unwrap().modified().unwrap()).unwrap()
}

/// What the compiler makes of a file in the folder `compile_fail`.
fn compile(file: &str, options: &[&str]) -> Output {
    let test = env::current_exe().unwrap();
    let libraries = test.parent().unwrap();
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
        .args(["--edition=2024", "--emit=metadata", "--out-dir", env!("CARGO_TARGET_TMPDIR")])
        .arg(format!("-Ldependency={}", libraries.display()))
        .arg(format!("--extern=rasterizer={}", rasterizer(libraries).display()))
        .args(options)
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("compile_fail").join(file))
        .output()
        .unwrap()
}

/// A display's pixels cannot be read: the compiler tells so, and where blending is possible. The
/// same program compiles for a frame.
#[test]
fn nothing_is_blended_with_a_display() {
    let onto_frame = compile("blend.rs", &["--cfg=readable"]);
    let told = String::from_utf8_lossy(&onto_frame.stderr);
    assert!(onto_frame.status.success(), "{told}");

    let onto_display = compile("blend.rs", &[]);
    let told = String::from_utf8_lossy(&onto_display.stderr);
    assert!(!onto_display.status.success(), "blending onto a display compiles");
    for words in [
        "error[E0277]: the pixels of `",
        "` cannot be read, so nothing can be blended with them",
        "its pixels cannot be read",
        "a display only takes pixels: blend in a `Frame` or in `Bands`, and send those",
    ] {
        assert!(told.contains(words), "\"{words}\" is not in:\n{told}");
    }
    assert_eq!(told.matches("error[").count(), 1, "{told}");
}
