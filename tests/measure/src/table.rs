//! Markdown tables with aligned columns, which read well on a terminal too.

use std::fmt;

use comfy_table::{CellAlignment, ContentLineStyle, Table as Grid, TableStyle};

/// A column: its heading, and the text of its cell in a row.
pub(crate) type Column<T> = (&'static str, fn(&T) -> String);

/// A table whose first columns hold words. The others hold figures and are aligned right.
#[derive(Clone, Debug)]
pub(crate) struct Table(Grid);

impl Table {
    /// A table without rows. The first `words` columns hold words.
    pub(crate) fn new(words: usize, headings: &[&str]) -> Self {
        let bars = ContentLineStyle::new('|', '|', '|');
        let mut grid = Grid::new();
        grid.load_style(TableStyle::new().content_lines(bars));
        grid.add_row(headings);
        // An ordinary row, because the crate's own line below the headings has no colons.
        let rule = |column| if column < words { "---" } else { "---:" };
        grid.add_row((0..headings.len()).map(rule));
        for column in grid.column_iter_mut().skip(words) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        Self(grid)
    }

    /// A table of these columns with a row for each item.
    pub(crate) fn of<T>(
        words: usize,
        columns: &[Column<T>],
        items: impl IntoIterator<Item = T>,
    ) -> Self {
        let headings: Vec<_> = columns.iter().map(|(heading, _)| *heading).collect();
        let mut table = Self::new(words, &headings);
        for item in items {
            table.row(columns.iter().map(|(_, cell)| cell(&item)));
        }
        table
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.0.add_row(cells);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_aligned_left_and_figures_right() {
        let columns: [Column<(&str, &str)>; 2] =
            [("scene", |row| row.0.into()), ("pixels", |row| row.1.into())];
        let table = Table::of(1, &columns, [("cube", "54,617"), ("a sphere", "7")]);
        let expected = "\
| scene    | pixels |
| ---      |   ---: |
| cube     | 54,617 |
| a sphere |      7 |
";
        assert_eq!(table.to_string(), expected);
    }
}
