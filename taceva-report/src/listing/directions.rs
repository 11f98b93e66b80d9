//! Which numbers of a listing are good: a sign for people, a word for programs.

use std::borrow::Cow;

use taceva_metrics::Better;

use super::Listing;

/// The column that says it to programs.
const COLUMN: &str = "better";

/// Which numbers of a listing are good.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Directions {
    /// Nobody asks: they are no scores.
    #[default]
    None,
    /// Row by row.
    Rows {
        /// The column that names what a row is of; people find the sign behind it, programs a column `better` beside it.
        column: usize,
        /// A direction a row; none of what is not known.
        of: Vec<Option<Better>>,
    },
    /// Column by column: people find the sign in the head; programs know columns by their names.
    Columns(Vec<Option<Better>>),
}

impl Directions {
    /// Of rows whose cell in `column` is the name of a metric or variant.
    pub fn of_metrics(rows: &[Vec<String>], column: usize) -> Directions {
        let of = rows
            .iter()
            .map(|row| row.get(column).and_then(|name| Better::of(name)));
        Directions::Rows {
            column,
            of: of.collect(),
        }
    }

    /// `listing` with signs.
    pub(super) fn signed<'a>(&self, listing: &'a Listing) -> Cow<'a, Listing> {
        match self {
            Directions::None => Cow::Borrowed(listing),
            Directions::Rows { column, of } => {
                let mut listing = listing.clone();
                for (row, better) in listing.rows.iter_mut().zip(of) {
                    sign(row.get_mut(*column), *better);
                }
                Cow::Owned(listing)
            }
            Directions::Columns(of) => {
                let mut listing = listing.clone();
                for (name, better) in listing.head.iter_mut().zip(of) {
                    sign(Some(name), *better);
                }
                Cow::Owned(listing)
            }
        }
    }

    /// `listing` with a column of words.
    pub(super) fn worded<'a>(&self, listing: &'a Listing) -> Cow<'a, Listing> {
        let Directions::Rows { column, of } = self else {
            return Cow::Borrowed(listing);
        };
        let mut listing = listing.clone();
        listing.head.insert(column + 1, COLUMN.to_owned());
        for (at, row) in listing.rows.iter_mut().enumerate() {
            let better = of.get(at).copied().flatten();
            let word = better.map_or("", Better::name);
            row.insert(column + 1, word.to_owned());
        }
        Cow::Owned(listing)
    }
}

fn sign(name: Option<&mut String>, better: Option<Better>) {
    // A cell that repeats the one above it is empty, and stays so.
    if let (Some(name), Some(better)) = (name.filter(|name| !name.is_empty()), better) {
        *name = better.beside(name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_see_a_sign_and_programs_a_word() {
        let mut listing = Listing::new("Scores", &["n", "metric", "value"]);
        for metric in ["mae", "own", "r2"] {
            listing
                .rows
                .push(["1", metric, "0.5"].map(str::to_owned).to_vec());
        }
        listing.directions = Directions::of_metrics(&listing.rows, 1);
        for form in [listing.text(), listing.markdown(), listing.html()] {
            assert!(form.contains("mae ↓") && form.contains("r2 ↑"), "{form}");
            assert!(!form.contains("own ") || !form.contains("own ↓"), "{form}");
        }
        assert!(listing.latex().contains("mae $\\downarrow$"));
        let csv = "n,metric,better,value\n1,mae,lower,0.5\n1,own,,0.5\n1,r2,higher,0.5\n";
        assert_eq!(listing.csv(), csv);
        assert!(listing.json("x").contains("\"better\": \"higher\""));
    }

    #[test]
    fn heads_have_signs_for_people_alone() {
        let mut listing = Listing::new("Models", &["model", "MAE Fz (N)"]);
        listing
            .rows
            .push(["ridge", "0.1"].map(str::to_owned).to_vec());
        listing.directions = Directions::Columns(vec![None, Some(Better::Lower)]);
        assert!(listing.text().contains("MAE Fz (N) ↓"));
        assert_eq!(listing.csv(), "model,MAE Fz (N)\nridge,0.1\n");
    }
}
