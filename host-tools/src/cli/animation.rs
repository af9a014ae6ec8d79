//! Pictures and animations as files: their format by the ending of the name, and their times.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};

use super::{
    gif,
    image::Image,
    output::{self, Kind},
    png,
};

/// The time in seconds that a full turn takes, unless the frames of a second are chosen.
const TURN_SECONDS: u32 = 3;
/// Many viewers slow down animations with more frames per second than this.
pub(super) const MOST_FRAMES_A_SECOND: u32 = 50;

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// PNG, animated if it has several frames.
    Png,
    /// Animated GIF.
    Gif,
}

impl Format {
    /// By the ending of a name; the standard output gets PNG.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let is = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        if output::is_standard(path) || is("png") {
            Some(Self::Png)
        } else {
            is("gif").then_some(Self::Gif)
        }
    }

    /// The frames of a turntable whose number is not chosen: a PNG file shows one picture.
    pub(super) const fn frames(self) -> u32 {
        match self {
            Self::Png => 1,
            Self::Gif => 36,
        }
    }

    /// How many frames are drawn for a file of `frames`.
    pub(super) fn drawn_frames(self, frames: u32) -> u32 {
        match self {
            Self::Png => frames,
            Self::Gif => frames + gif::sampled_frames(frames),
        }
    }

    /// Which files of this format may be overwritten.
    pub(super) const fn kind(self) -> Kind {
        match self {
            Self::Png => output::PNG,
            Self::Gif => output::GIF,
        }
    }

    /// The bytes of a file. `image` draws a frame, and may be called several times for one.
    pub(super) fn encode(
        self,
        size: [u32; 2],
        timing: Timing,
        image: impl FnMut(u32) -> Result<Image>,
    ) -> Result<Vec<u8>> {
        match self {
            Self::Png => png::animation(size, timing, (0..timing.frames).map(image)),
            Self::Gif => gif::animation(size, timing, image),
        }
    }
}

/// Refuses the ending of another format.
pub(super) fn picture_file(path: PathBuf) -> Result<PathBuf, &'static str> {
    if Format::of(&path).is_some() {
        Ok(path)
    } else {
        Err(
            "pictures are PNG files and animations PNG or GIF files: give the name the ending .png \
             or .gif",
        )
    }
}

/// How many frames there are, and when each is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Timing {
    /// How many, at least 1.
    pub(super) frames: u32,
    /// The seconds of a frame, as a fraction.
    pub(super) delay: [u16; 2],
}

impl Timing {
    /// Of a number of frames, and of the frames a second if these are chosen.
    pub(super) fn new(frames: u32, per_second: Option<u16>) -> Result<Self> {
        ensure!(
            frames > 1 || per_second.is_none(),
            "--fps is for animations: choose how many frames a turn has, as in --frames 36"
        );
        let delay = match per_second {
            Some(per_second) => [1, per_second],
            None if frames > TURN_SECONDS * MOST_FRAMES_A_SECOND => {
                [1, MOST_FRAMES_A_SECOND as u16]
            }
            None => [TURN_SECONDS as u16, u16::try_from(frames)?],
        };
        Ok(Self { frames, delay })
    }

    /// One picture.
    pub(super) const STILL: Self = Self { frames: 1, delay: [1, 1] };

    /// How long a frame is shown, in hundredths of a second. Each begins at its time, rounded: so
    /// all of them together take the time that they should.
    pub(super) fn hundredths(self, frame: u32) -> u16 {
        let [seconds, parts] = self.delay.map(u32::from);
        let begin = |frame: u32| (2 * frame * seconds * 100 + parts) / (2 * parts);
        (begin(frame + 1) - begin(frame)) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_add_up_to_the_whole_time() {
        for (frames, per_second, whole) in [
            (36, None, 300),
            (7, None, 300),
            (60, Some(30), 200),
            (9, Some(7), 129),
            (360, None, 720),
        ] {
            let timing = Timing::new(frames, per_second).unwrap();
            let delays: Vec<u16> = (0..frames).map(|frame| timing.hundredths(frame)).collect();
            assert_eq!(delays.iter().sum::<u16>(), whole, "{timing:?}");
            let [least, most] = [delays.iter().min(), delays.iter().max()];
            assert!(most.unwrap() - least.unwrap() <= 1, "{delays:?}");
        }
        assert!(Timing::new(1, Some(25)).is_err());
    }

    #[test]
    fn the_ending_is_the_format() {
        let of = |name: &str| Format::of(Path::new(name));
        assert_eq!(["a.png", "a.PNG", "-"].map(of), [Some(Format::Png); 3]);
        assert_eq!(["b/a.gif", "a.Gif"].map(of), [Some(Format::Gif); 2]);
        assert_eq!(["a.jpg", "a", "gif", ".png", "a.webp", "a.mp4"].map(of), [None; 6]);
    }
}
