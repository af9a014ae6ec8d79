//! Tables of aligned columns.

/// A table: a first column of names, and columns of figures.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    /// How many columns, from the first on, are of words: they begin at the left, the others end
    /// at the right.
    words: usize,
}

impl Table {
    /// A table with a heading over each column; the first `words` columns are of words.
    pub(crate) fn new(words: usize, headings: &[&str]) -> Self {
        let rows = vec![headings.iter().map(|&heading| heading.to_owned()).collect()];
        Self { rows, words }
    }

    /// One row more. It may end before the last column.
    pub(crate) fn row<I: IntoIterator<Item: Into<String>>>(&mut self, cells: I) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// For a terminal: columns two spaces apart.
    pub(crate) fn aligned(&self) -> String {
        let widths = self.widths();
        let mut text = String::new();
        for row in &self.rows {
            let cells = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| {
                if column < self.words {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
            let line = cells.collect::<Vec<_>>().join("  ");
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text
    }

    /// For a Markdown file.
    pub(crate) fn markdown(&self) -> String {
        let columns = self.widths().len();
        let mut text = String::new();
        for (number, row) in self.rows.iter().enumerate() {
            let cell = |column: usize| row.get(column).map_or("", String::as_str);
            let cells = (0..columns).map(cell).collect::<Vec<_>>();
            text.push_str(&format!("| {} |\n", cells.join(" | ")));
            if number == 0 {
                let rules =
                    (0..columns).map(|column| if column < self.words { "---" } else { "---:" });
                text.push_str(&format!("| {} |\n", rules.collect::<Vec<_>>().join(" | ")));
            }
        }
        text
    }

    fn widths(&self) -> Vec<usize> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or_default();
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or_default()
        };
        (0..columns).map(width).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(1, &["scene", "pixels", "met"]);
        table.row(["cube", "54,617", "yes"]);
        table.row(["a sphere", "7"]);
        table
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        assert_eq!(
            table().aligned(),
            "scene     pixels  met\ncube      54,617  yes\na sphere       7\n"
        );
    }

    #[test]
    fn markdown_has_every_column_in_every_row() {
        let expected = "| scene | pixels | met |\n| --- | ---: | ---: |\n| cube | 54,617 | yes |\n| a sphere | 7 |  |\n";
        assert_eq!(table().markdown(), expected);
    }
}
