//! The first example of `taceva-metrics` compiles and runs in a project outside the workspace, from the packed crates.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_tests::root;

const CRATES: [&str; 2] = ["taceva-core", "taceva-metrics"];

/// Runs `command`, which must succeed, and returns its output.
fn succeed(command: &mut Command) -> String {
    let output = command.output().expect("the program starts");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {told}{printed}");
    printed
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Packs the crates that the example needs, and unpacks them below `folder`, as a registry would deliver them. Returns the name and the folder of
/// each.
fn unpacked(folder: &Path) -> Vec<(&'static str, PathBuf)> {
    let built = folder.join("packed");
    let mut package = cargo();
    package.current_dir(root()).args([
        "package",
        "--quiet",
        "--no-verify",
        "--allow-dirty",
        "--offline",
    ]);
    package.arg("--target-dir").arg(&built);
    for name in CRATES {
        package.args(["--package", name]);
    }
    succeed(&mut package);
    CRATES
        .map(|name| {
            let named = format!("{name}-{}", env!("CARGO_PKG_VERSION"));
            let packed = built.join(format!("package/{named}.crate"));
            succeed(
                Command::new("tar")
                    .arg("-xzf")
                    .arg(&packed)
                    .arg("-C")
                    .arg(folder),
            );
            (name, folder.join(named))
        })
        .to_vec()
}

/// First Rust example of a document, as a complete program.
fn first_example(document: &str) -> String {
    let (_, from) = document.split_once("```rust\n").expect("an example");
    let (example, _) = from.split_once("```").expect("its end");
    let lines = example
        .lines()
        .map(|line| line.strip_prefix("# ").unwrap_or(line));
    let body: Vec<&str> = lines.collect();
    format!(
        "fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{}\n}}\n",
        body.join("\n")
    )
}

#[test]
fn the_program_on_the_page_is_the_example_that_is_built() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect("there");
    let page = read("docs/embedding.md");
    let (_, from) = page.split_once("```rust\n").expect("a program");
    let (program, _) = from.split_once("```").expect("its end");
    let example = read("taceva-metrics/examples/ten_lines.rs");
    assert!(example.ends_with(program), "{program}");
}

#[test]
fn the_first_example_of_the_metrics_runs_in_a_fresh_project_from_packaged_crates() {
    let folder = tempfile::tempdir().expect("a folder");
    let crates = unpacked(folder.path());
    let project = folder.path().join("lab");
    fs::create_dir_all(project.join("src")).expect("a folder");
    let of = |name: &str| {
        let (_, path) = crates
            .iter()
            .find(|(known, _)| *known == name)
            .expect("a crate");
        path.display().to_string()
    };
    let manifest = format!(
        "[package]\nname = \"lab\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\ntaceva-metrics = {{ path = {:?} }}\n\n\
         [patch.crates-io]\ntaceva-core = {{ path = {:?} }}\n",
        of("taceva-metrics"),
        of("taceva-core")
    );
    fs::write(project.join("Cargo.toml"), manifest).expect("written");
    fs::copy(root().join("Cargo.lock"), project.join("Cargo.lock")).expect("copied");
    let readme = fs::read_to_string(Path::new(&of("taceva-metrics")).join("README.md"))
        .expect("the packaged README");
    let example = first_example(&readme);
    let lines = example.lines().filter(|line| !line.trim().is_empty());
    assert!(lines.clone().count() <= 13, "ten lines: {example}");
    fs::write(project.join("src/main.rs"), &example).expect("written");

    let target = folder.path().join("target");
    let mut run = cargo();
    run.current_dir(&project)
        .args(["run", "--quiet", "--offline"]);
    run.env("CARGO_TARGET_DIR", &target);
    succeed(&mut run);
    let tree = succeed(cargo().current_dir(&project).args([
        "tree",
        "--offline",
        "--prefix",
        "none",
        "--edges",
        "normal",
    ]));
    let names = tree.lines().filter_map(|line| line.split(' ').next());
    let ours: Vec<&str> = names.filter(|name| name.starts_with("taceva")).collect();
    assert_eq!(ours, ["taceva-metrics", "taceva-core"], "{tree}");
}
