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

/// What the compiler makes of a file.
pub(crate) fn compile(file: &Path, options: &[&str]) -> Output {
    let test = env::current_exe().unwrap();
    let libraries = test.parent().unwrap();
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
        .args(["--edition=2024", "--emit=metadata", "--out-dir", env!("CARGO_TARGET_TMPDIR")])
        .arg(format!("-Ldependency={}", libraries.display()))
        .arg(format!("--extern=rasterizer={}", rasterizer(libraries).display()))
        .args(options)
        .arg(file)
        .output()
        .unwrap()
}

/// Compiles a file of the folder `compile_fail`, which succeeds, and with another option, which
/// fails with one error that has these words.
fn fails(file: &str, right: &[&str], wrong: &[&str], words: &[&str]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("compile_fail").join(file);
    let compiled = compile(&path, right);
    let told = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{told}");

    let refused = compile(&path, wrong);
    let told = String::from_utf8_lossy(&refused.stderr);
    assert!(!refused.status.success(), "{file} compiles with {wrong:?}");
    for words in words {
        assert!(told.contains(words), "\"{words}\" is not in:\n{told}");
    }
    assert_eq!(told.matches("error[").count(), 1, "{told}");
}

const UNREADABLE: [&str; 4] = [
    "error[E0277]: the pixels of `",
    "` cannot be read, so nothing can be blended with them",
    "its pixels cannot be read",
    "a display only takes pixels: blend in a `Frame` or in `Bands`, and send those",
];

/// A display's pixels cannot be read: the compiler tells so, and where blending is possible. The
/// same program compiles for a frame.
#[test]
fn nothing_is_blended_with_a_display() {
    fails("blend.rs", &["--cfg=readable"], &[], &UNREADABLE);
    fails("over.rs", &[], &["--cfg=display"], &UNREADABLE);
}

/// A pixel that is on or off has no half: the compiler tells so, and what to do.
#[test]
fn nothing_is_blended_with_pixels_of_one_bit() {
    fails(
        "over.rs",
        &[],
        &["--cfg=binary"],
        &[
            "error[E0277]: `BinaryColor` cannot be blended with another colour",
            "its colours cannot be mixed",
            "a pixel of `BinaryColor` is on or off: it takes `Replace`, and a shader or texels that \
             discard pixels",
            "draw in `Gray8` or `Rgb888`, and dither what is sent",
        ],
    );
}
