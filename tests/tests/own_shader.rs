//! The example of a user's shader draws contour lines.

#[path = "../../rasterizer/examples/own_shader.rs"]
#[expect(dead_code, reason = "the example's main is not called")]
mod own_shader;

/// The background is on all sides, and both materials show coloured slices and black ones.
#[test]
fn contours_run_round_the_cube() {
    let text = own_shader::picture().unwrap();
    print!("{text}");
    let rows: Vec<Vec<char>> = text.lines().map(|line| line.chars().collect()).collect();
    assert!(rows.len() == 24 && rows.iter().all(|row| row.len() == 64));
    for (shade, least) in [('.', 400), (' ', 200), ('+', 50), ('#', 100)] {
        let pixels = text.chars().filter(|&c| c == shade).count();
        assert!(pixels > least, "{pixels} of '{shade}'");
    }
    for corner in [rows[0][0], rows[0][63], rows[23][0], rows[23][63]] {
        assert_eq!(corner, '.');
    }
}
