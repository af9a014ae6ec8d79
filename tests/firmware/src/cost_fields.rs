//! The figures that the firmware adds up over frames and prints. The program that reads them
//! includes this file, so that each figure is declared once.

/// Hands the figures to the macro `$declare`. The first is the number of frames.
macro_rules! cost_fields {
    ($declare:ident) => {
        $declare! {
            /// Frames.
            frames,
            /// Setting depth to the far end.
            clear,
            /// Transforming, lighting and projecting vertices.
            vertices,
            /// Culling triangles, setting them up, walking down their rows, and drawing their
            /// pixels unless the set-up alone is measured.
            draw,
            /// Pixels that the frames cover.
            pixels_drawn,
            /// Triangles that are left after culling and clipping.
            triangles_drawn,
            /// Pixels of the smallest rectangle that holds what a frame and the one before it show.
            pixels_changed,
        }
    };
}
