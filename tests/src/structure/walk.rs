//! Path of one value through the program, as stated in `ARCHITECTURE.md`: one line per stop, with `file` and function.

use std::collections::BTreeSet;
use std::fs;

use crate::{read, root};

/// One stop: a function in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Stop {
    file: String,
    function: String,
}

/// Path of one value through the program.
#[derive(Debug)]
pub struct Walk {
    /// Heading of the path.
    pub name: String,
    stops: Vec<Stop>,
}

impl Walk {
    /// Number of functions that the value passes.
    pub fn stops(&self) -> usize {
        self.stops.len()
    }

    /// Number of stops in a file that the value had already left before.
    pub fn returns(&self) -> usize {
        let mut left = BTreeSet::new();
        let mut returns = 0;
        for (at, stop) in self.stops.iter().enumerate() {
            let stays = at > 0 && self.stops[at - 1].file == stop.file;
            returns += usize::from(!stays && left.contains(&stop.file));
            left.insert(stop.file.clone());
        }
        returns
    }

    /// Outdated stops: the file lacks the function, or the function does not name the next one.
    ///
    /// # Panics
    /// If a stop names no file, which ends the test.
    pub fn mistakes(&self) -> Vec<String> {
        let mut found = Vec::new();
        for (at, stop) in self.stops.iter().enumerate() {
            let path = root().join(&stop.file);
            let code =
                fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", stop.file));
            let Some(start) = code.find(&format!("fn {}", stop.function)) else {
                found.push(format!("{}: no function `{}`", stop.file, stop.function));
                continue;
            };
            let body = &code[start..];
            let body = body[3..].find("\nfn ").map_or(body, |end| &body[..end]);
            let next = self
                .stops
                .get(at + 1)
                .filter(|next| !body.contains(&next.function));
            found.extend(next.map(|next| {
                format!(
                    "{}: `{}` does not name `{}`",
                    stop.file, stop.function, next.function
                )
            }));
        }
        found
    }
}

/// Paths stated in `ARCHITECTURE.md`: after each heading `### The way of …`, lines `1. \`file\`: \`function\`: …`.
pub fn walks() -> Vec<Walk> {
    let text = read("ARCHITECTURE.md");
    let sections = text.split("\n### The way of ").skip(1);
    sections
        .map(|section| {
            let name = section.lines().next().unwrap_or_default().to_owned();
            let lines = section.lines().take_while(|line| !line.starts_with('#'));
            let stops = lines.filter_map(|line| {
                let (number, rest) = line.split_once(". `")?;
                number.parse::<usize>().ok()?;
                let (file, rest) = rest.split_once("`: `")?;
                let (function, _) = rest.split_once('`')?;
                Some(Stop {
                    file: file.to_owned(),
                    function: function.to_owned(),
                })
            });
            Walk {
                name,
                stops: stops.collect(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Stop, Walk};

    #[test]
    fn a_return_is_a_stop_in_a_file_that_was_left() {
        let stop = |file: &str| Stop {
            file: file.to_owned(),
            function: "f".to_owned(),
        };
        let walk = Walk {
            name: String::new(),
            stops: ["a", "a", "b", "a", "c", "b"].map(stop).to_vec(),
        };
        assert_eq!((walk.stops(), walk.returns()), (6, 2));
    }
}
