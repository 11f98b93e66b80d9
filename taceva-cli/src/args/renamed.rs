//! Former names of options: still read, with a note.

use std::path::PathBuf;

use clap::Args;

/// `import --to`, which is `--out` elsewhere.
#[derive(Debug, Args)]
pub(crate) struct FormerTo {
    #[arg(
        long = "to",
        hide = true,
        value_name = "DATASET",
        conflicts_with = "out"
    )]
    pub(crate) to: Option<PathBuf>,
}

/// `cache prune --dry-run`, which is `--explain` elsewhere.
#[derive(Debug, Args)]
pub(crate) struct FormerDryRun {
    #[arg(long, hide = true, conflicts_with = "explain")]
    pub(crate) dry_run: bool,
}

/// `choose --from`, now `--results`.
#[derive(Debug, Args)]
pub(crate) struct FormerFrom {
    #[arg(long, hide = true, value_name = "RESULT", conflicts_with = "results")]
    pub(crate) from: Vec<PathBuf>,
}

/// `catalogue site --with`, now `--results`.
#[derive(Debug, Args)]
pub(crate) struct FormerWith {
    #[arg(long, hide = true, value_name = "RESULT", conflicts_with = "results")]
    pub(crate) with: Vec<PathBuf>,
}

/// `plugin headers DIR`, now `--out DIR`.
#[derive(Debug, Args)]
pub(crate) struct FormerFolder {
    #[arg(hide = true, value_name = "DIR", conflicts_with = "out")]
    pub(crate) folder: Option<PathBuf>,
}
