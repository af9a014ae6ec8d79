//! The program as a user runs it, in a directory of its own.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// The program, to be started in a directory.
pub(crate) fn program(directory: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-tools"));
    command.current_dir(directory);
    command
}

/// Runs it with the words of a line.
pub(crate) fn run(directory: &Path, line: &str) -> Output {
    program(directory).args(line.split_whitespace()).output().unwrap()
}

/// What it has written.
pub(crate) fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Runs and expects success, with nothing on the standard error.
#[track_caller]
pub(crate) fn succeed(directory: &Path, line: &str) -> String {
    let output = run(directory, line);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""), "{line}");
    text(&output.stdout).to_owned()
}

/// Runs and expects one clear refusal: status 2, nothing on the standard output, no new file.
#[track_caller]
pub(crate) fn refusal(directory: &Path, line: &str) -> String {
    let before = files(directory);
    let output = run(directory, line);
    let complaint = text(&output.stderr).to_owned();
    assert_eq!(output.status.code(), Some(2), "{line}: {complaint}");
    assert_eq!(text(&output.stdout), "", "{line}");
    assert!(
        complaint.starts_with("error: ") && !complaint.contains("panicked"),
        "{line}: {complaint}"
    );
    assert_eq!(files(directory), before, "{line}");
    complaint
}

/// The same, whose message has this part.
#[track_caller]
pub(crate) fn refuse(directory: &Path, line: &str, part: &str) {
    let complaint = refusal(directory, line);
    assert!(complaint.contains(part), "{line}: {complaint}");
}

/// All files and directories below a directory.
pub(crate) fn files(directory: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        }
        found.push(path);
    }
    found.sort();
    found
}
