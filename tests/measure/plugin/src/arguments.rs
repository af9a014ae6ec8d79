//! The arguments of the plugin, as in
//! `-plugin libcycles_plugin.so,out=counts.json,marks=0x20000000:3,cache=0:0x200000:8:1024:2`.

use std::path::PathBuf;

use crate::{
    cache::Cache,
    windows::{Flash, Marks},
};

/// What to count, and where to write the counts.
#[derive(Clone, Debug)]
pub struct Arguments {
    /// The file that the reports are written to.
    pub out: PathBuf,
    /// `ADDRESS:STAGES`.
    pub marks: Marks,
    /// `START:LENGTH:LINE_BYTES:SETS:WAYS`; without it no cache is looked at.
    pub flash: Option<Flash>,
}

impl Arguments {
    /// Parses `NAME=VALUE`s.
    ///
    /// # Errors
    ///
    /// Returns a message if one is unknown, missing or malformed.
    pub fn parse<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Result<Self, String> {
        let (mut out, mut marks, mut flash) = (None, None, None);
        for argument in arguments {
            let malformed = || format!("`{argument}` is malformed");
            let (name, value) = argument.split_once('=').ok_or_else(malformed)?;
            match name {
                "out" => out = Some(value.into()),
                "marks" => {
                    let [address, stages] = numbers(value).ok_or_else(malformed)?;
                    marks = Some(Marks { address, stages: stages as usize });
                }
                "cache" => {
                    let [start, length, line_bytes, sets, ways] =
                        numbers(value).ok_or_else(malformed)?;
                    if !line_bytes.is_power_of_two() || !sets.is_power_of_two() || ways == 0 {
                        return Err(malformed());
                    }
                    let cache = Cache::new(line_bytes, sets, ways as usize);
                    flash = Some(Flash { start, length, cache });
                }
                _ => return Err(format!("there is no argument `{name}`")),
            }
        }
        let out = out.ok_or("`out=FILE` is missing")?;
        Ok(Self { out, marks: marks.ok_or("`marks=ADDRESS:STAGES` is missing")?, flash })
    }
}

/// Numbers between colons, decimal or with `0x`.
fn numbers<const N: usize>(text: &str) -> Option<[u32; N]> {
    let number = |text: &str| match text.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    let numbers: Option<Vec<u32>> = text.split(':').map(number).collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_parsed() {
        let all = ["out=a/b.json", "marks=0x100:3", "cache=0:0x1000:8:1024:2"];
        let arguments = Arguments::parse(all).unwrap();
        assert_eq!(arguments.out, PathBuf::from("a/b.json"));
        assert_eq!(arguments.marks, Marks { address: 256, stages: 3 });
        let flash = arguments.flash.unwrap();
        assert_eq!((flash.start, flash.length, flash.cache.line(17)), (0, 4096, 2));
        assert!(Arguments::parse(all[..2].iter().copied()).unwrap().flash.is_none());
    }

    #[test]
    fn faults_are_named() {
        let fault = |all: &[&str]| Arguments::parse(all.iter().copied()).unwrap_err();
        assert!(fault(&["marks=0:1"]).contains("out=FILE"));
        assert!(fault(&["out=x"]).contains("marks=ADDRESS"));
        assert!(fault(&["out=x", "stages=1"]).contains("no argument `stages`"));
        for malformed in ["marks=0", "marks=x:1", "cache=0:1:7:1:1", "cache=0:1:8:1:0", "verbose"] {
            assert!(fault(&["out=x", malformed]).contains(malformed));
        }
    }
}
