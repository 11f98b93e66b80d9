//! Places that duplicate a concept.

use super::sources::Source;

/// One concept, and the code words that show where it is implemented.
#[derive(Debug)]
pub struct Copies {
    /// Name of the concept.
    pub concept: &'static str,
    /// Words of product code; every copy contains one of them.
    pub words: &'static [&'static str],
    /// Greatest number of files that may contain the concept.
    pub most: usize,
}

/// Concepts that must be implemented once.
pub const COPIES: &[Copies] = &[
    Copies {
        concept: "suggestion of a similar name",
        words: &["strsim::", "fn edits("],
        most: 1,
    },
    Copies {
        concept: "guard against panics",
        words: &["catch_unwind("],
        most: 1,
    },
    Copies {
        concept: "FNV hash",
        words: &["0xcbf2_9ce4_8422_2325"],
        most: 1,
    },
    Copies {
        concept: "struct Finding",
        words: &["struct Finding "],
        most: 1,
    },
    Copies {
        concept: "struct Report",
        words: &["struct Report ", "struct Report<"],
        most: 1,
    },
    Copies {
        concept: "planes of two channels",
        words: &["const PLANES:"],
        most: 1,
    },
    Copies {
        concept: "least number of clusters for an interval",
        words: &["LEAST_CLUSTERS:", "CLUSTERS_LEAST:"],
        most: 1,
    },
    Copies {
        concept: "struct SeedScore",
        words: &["struct SeedScore "],
        most: 1,
    },
    Copies {
        concept: "promises of drivers",
        words: &["fn halts_from_another_thread("],
        most: 1,
    },
    Copies {
        // The number of a metric, and its row in a result.
        concept: "struct Score",
        words: &["pub struct Score {"],
        most: 2,
    },
    Copies {
        // Reports from rows, from one or several stored states, and from arrays in memory.
        concept: "report of an evaluation",
        words: &["EvaluationReport::new("],
        most: 4,
    },
];

/// Product files that contain one of the concept's words.
pub fn copies<'a>(concept: &Copies, sources: &'a [Source]) -> Vec<&'a str> {
    let files = sources.iter().filter(|source| {
        concept
            .words
            .iter()
            .any(|word| source.product_code.contains(word))
    });
    files.map(|source| source.path.as_str()).collect()
}
