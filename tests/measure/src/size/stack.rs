//! The stack that a program needs, measured in QEMU.
//!
//! The RAM from the end of the statics to the top of the stack is painted before the core starts:
//! QEMU's loader writes a pattern there, and the runtime clears only the statics. When the program
//! asks for a reset, QEMU stops instead, and the stack extends down to the lowest word that has
//! lost its paint. A reset of the RISC-V board takes `unsafe` code: there the program sets a static
//! at its end, and the machine is stopped then. Words that a function reserves and never writes
//! keep theirs, but as soon as it calls another function, words below them lose it. Nothing
//! interrupts these programs: what interrupts add (32 bytes on a Cortex-M0+, 104 with an FPU in
//! use, and their handlers) is not included.

use std::{
    fs,
    io::{BufRead as _, BufReader, Write as _},
    path::Path,
    process::{Child, Command, Stdio},
    sync::mpsc::{self, Receiver, RecvTimeoutError},
    thread,
    time::{Duration, Instant},
};

use anyhow::{Context as _, Result, bail, ensure};
use serde_json::{Value, json};

use super::image::Image;
use crate::cores::Core;

/// A word that no program writes except by chance.
const PAINT: u32 = 0x5AC3_96E1;

/// The longest that a program may run.
const PATIENCE: Duration = Duration::from_secs(30);

/// How long to wait before that static is read again.
const PAUSE: Duration = Duration::from_millis(20);

/// The static in which the firmware leaves the checksum of its pictures.
const CHECKSUM: &str = "firmware::sizes::CHECKSUM";

/// The static that it sets at its end on RISC-V.
const ENDED: &str = "firmware::sizes::ENDED";

/// What a run leaves in RAM.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    /// Bytes of stack.
    pub(crate) stack: u32,
    /// The checksum of the pictures.
    pub(crate) checksum: u32,
}

/// Runs a program to its end.
///
/// # Errors
///
/// Returns an error if QEMU cannot be run, the program does not end, or its stack reaches its
/// statics.
pub(crate) fn run(core: Core, program: &Path, image: &Image) -> Result<Run> {
    let bottom = image.statics.end.next_multiple_of(4);
    let free = image.stack_top.checked_sub(bottom);
    let free = free.context("the statics leave no room for a stack")? as usize;
    let [paint, memory] = ["paint", "memory"].map(|extension| program.with_extension(extension));
    fs::write(&paint, painted(free))
        .with_context(|| format!("{} cannot be written", paint.display()))?;

    let mut machine = Machine::start(core, program, &paint, bottom)?;
    machine.execute("cont", &json!({}))?;
    let ended = match core {
        Core::Riscv => machine.wait_for_word(image.address_of(ENDED)?, &memory),
        _ => machine.next(|value| value["event"] == "STOP").map(drop),
    };
    ended.with_context(|| {
        let (program, core) = (program.display(), core.title());
        format!("{program} did not end on {core}: it panics or is in an endless loop")
    })?;
    let start = image.statics.start;
    let size = image.stack_top - start;
    let ram = machine.memory(start, size, &memory)?;
    machine.execute("quit", &json!({}))?;
    machine.process.wait()?;
    for file in [paint, memory] {
        fs::remove_file(&file).with_context(|| format!("{} cannot be removed", file.display()))?;
    }
    ensure!(ram.len() == size as usize, "QEMU has written {} bytes of RAM, not {size}", ram.len());
    let stack = used(&ram[(bottom - start) as usize..]);
    ensure!(stack < free, "the stack has reached the statics: {free} bytes are too few");
    let checksum = image.address_of(CHECKSUM)? - start;
    let checksum = ram.get(checksum as usize..).and_then(|rest| rest.first_chunk());
    Ok(Run {
        stack: stack as u32,
        checksum: u32::from_le_bytes(*checksum.context("the checksum lies outside the statics")?),
    })
}

fn painted(bytes: usize) -> Vec<u8> {
    PAINT.to_le_bytes().repeat(bytes / 4)
}

/// The number of bytes from the first word without paint to the end.
fn used(memory: &[u8]) -> usize {
    let words = memory.chunks_exact(4);
    let intact = words.take_while(|word| **word == PAINT.to_le_bytes()).count();
    memory.len() - 4 * intact
}

/// A running QEMU and its QMP connection: lines of JSON on its standard input and output (QEMU,
/// *QMP Reference*).
struct Machine {
    process: Child,
    lines: Receiver<Value>,
}

impl Machine {
    /// A board with a program that has not started yet.
    fn start(core: Core, program: &Path, paint: &Path, bottom: u32) -> Result<Self> {
        let mut process = Command::new(core.emulator())
            .arg("-machine")
            .args(core.facts().board)
            .args([
                "-S", "-display", "none", "-serial", "none", "-monitor", "none", "-qmp", "stdio",
            ])
            // The program ends by a reset: stop there, and keep the memory.
            .args(["-action", "reboot=shutdown,shutdown=pause"])
            .arg("-device")
            .arg(format!("loader,file={},addr={bottom:#x},force-raw=on", paint.display()))
            .arg("-kernel")
            .arg(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .with_context(|| format!("{} could not be started", core.emulator()))?;
        let output = process.stdout.take().context("QEMU has no output")?;
        let (sender, lines) = mpsc::channel();
        thread::spawn(move || {
            let values = BufReader::new(output).lines().map_while(Result::ok);
            // The receiver is dropped first when the machine is.
            let _ = values
                .filter_map(|line| serde_json::from_str(&line).ok())
                .try_for_each(|value| sender.send(value));
        });
        let mut machine = Self { process, lines };
        machine.execute("qmp_capabilities", &json!({}))?;
        Ok(machine)
    }

    /// Sends a command and waits for its result.
    fn execute(&mut self, command: &str, arguments: &Value) -> Result<()> {
        let input = self.process.stdin.as_mut().context("QEMU has no input")?;
        // In one write: QEMU ends at the last brace of `quit`.
        let line = json!({ "execute": command, "arguments": arguments }).to_string() + "\n";
        input.write_all(line.as_bytes())?;
        let answer =
            self.next(|value| value.get("return").is_some() || value.get("error").is_some());
        let answer = answer.with_context(|| format!("QEMU does not answer to {command}"))?;
        match answer.get("error") {
            Some(error) => bail!("QEMU refuses {command}: {error}"),
            None => Ok(()),
        }
    }

    /// Reads memory by way of a file.
    fn memory(&mut self, start: u32, size: u32, file: &Path) -> Result<Vec<u8>> {
        let arguments = json!({ "val": start, "size": size, "filename": file });
        self.execute("pmemsave", &arguments)?;
        fs::read(file).with_context(|| format!("{} cannot be read", file.display()))
    }

    /// Waits until a word is no longer 0, and stops the machine.
    fn wait_for_word(&mut self, address: u32, file: &Path) -> Result<()> {
        let end = Instant::now() + PATIENCE;
        while self.memory(address, 4, file)?.iter().all(|&byte| byte == 0) {
            ensure!(Instant::now() < end, "nothing happens for {} seconds", PATIENCE.as_secs());
            thread::sleep(PAUSE);
        }
        self.execute("stop", &json!({}))
    }

    /// Waits for a message of a kind and skips others.
    fn next(&self, is_it: impl Fn(&Value) -> bool) -> Result<Value> {
        let end = Instant::now() + PATIENCE;
        loop {
            match self.lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(value) if is_it(&value) => return Ok(value),
                Ok(_) => {}
                Err(RecvTimeoutError::Timeout) => {
                    bail!("nothing happens for {} seconds", PATIENCE.as_secs())
                }
                Err(RecvTimeoutError::Disconnected) => bail!("QEMU has ended"),
            }
        }
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        // Both fail if it has ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stack_reaches_down_to_the_first_word_without_paint() {
        let mut memory = painted(64);
        assert_eq!(used(&memory), 0);
        memory[63] ^= 1;
        assert_eq!(used(&memory), 4);
        memory[20] ^= 0x80;
        assert_eq!(used(&memory), 44, "holes above the lowest word count");
        memory[0] ^= 1;
        assert_eq!(used(&memory), 64);
    }
}
