//! The frames of pictures that the program writes.

use std::{fs, io::BufReader, path::Path};

use super::program::succeed;

/// The frames of a PNG file, and the seconds of one as a fraction.
pub(crate) fn png_frames(path: &Path) -> (Vec<Vec<u8>>, Option<[u16; 2]>) {
    let file = BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let count = reader.info().animation_control.map_or(1, |animation| animation.num_frames);
    let mut delay = None;
    let frames = (0..count)
        .map(|_| {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            delay = reader.info().frame_control.map(|frame| [frame.delay_num, frame.delay_den]);
            pixels
        })
        .collect();
    (frames, delay)
}

/// The picture of a command without its output.
pub(crate) fn picture(directory: &Path, line: &str) -> Vec<u8> {
    succeed(directory, &format!("{line} -o one.png"));
    png_frames(&directory.join("one.png")).0.remove(0)
}
