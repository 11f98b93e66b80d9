//! Files of a new plugin in C.

use crate::kind::Kind;
use crate::name::Name;
use crate::project::{File, headers};

/// Sources and manifest of the example plugin in C: paths such as `src/sensor.c`, and their texts.
const EXAMPLE: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/example.rs"));

/// Files of a new plugin in C with one driver of `kind`: the driver of the example, the headers and a makefile.
pub fn c_project(kind: Kind, name: &Name) -> Vec<File> {
    let provides = provides(kind, name);
    let exported = match kind {
        Kind::Estimator => include_str!("../project/c/estimator.c.in"),
        _ => include_str!("../project/c/device.c.in"),
    };
    let manifest = [
        include_str!("../project/c/plugin.toml.in"),
        provides.as_str(),
    ]
    .concat();
    let fill = |text: &str| {
        text.replace("@introduction@", kind.introduction())
            .replace("@use@", kind.usage())
            .replace("@table@", &literal(&provides))
            .replace("@name@", name.as_str())
            .replace("@crate@", &name.as_crate())
            .replace("@A kind@", &kind.noun_with_article())
            .replace("@kind@", kind.name())
            .replace("@KIND@", &kind.name().to_uppercase())
    };
    let file = |path: &str, text: &str| File {
        path: path.to_owned(),
        text: text.to_owned(),
    };
    let driver = format!("src/{kind}.c");
    let mut files = vec![
        file("Makefile", &fill(include_str!("../project/c/Makefile.in"))),
        file(
            "README.md",
            &fill(include_str!("../project/c/README.md.in")),
        ),
        file(".gitignore", include_str!("../project/c/gitignore.in")),
        file("plugin.toml", &fill(&manifest)),
        file("src/plugin.c", &fill(exported)),
    ];
    for path in [driver.as_str(), "src/text.h", "src/waiting.h"] {
        files.push(file(path, example(path)));
    }
    files.extend(headers());
    files
}

fn example(path: &str) -> &'static str {
    let found = EXAMPLE.iter().find(|(known, _)| *known == path);
    found.map_or("", |found| found.1)
}

/// Table `[[provides]]` of the driver in the example, with the key `name`.
fn provides(kind: Kind, name: &Name) -> String {
    let of_kind = format!("kind = \"{kind}\"\n");
    let mut tables = example("plugin.toml").split("[[provides]]\n");
    let table = tables.find(|table| table.starts_with(&of_kind));
    // The second line is the key of the example.
    let rest: Vec<&str> = table.into_iter().flat_map(str::lines).skip(2).collect();
    let rest = rest.join("\n");
    format!("{of_kind}key = \"{name}\"\n{}\n", rest.trim_end())
}

/// Literal of C with the table, one line of text in each line.
fn literal(provides: &str) -> String {
    let table = provides.replace("[[provides.args]]", "[[args]]");
    let lines = table.lines().map(|line| {
        let line = line.replace('\\', "\\\\").replace('"', "\\\"");
        format!("    \"{line}\\n\"")
    });
    lines.collect::<Vec<String>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_in_c_has_a_driver_headers_and_one_table_in_code_and_manifest() {
        let name: Name = "my-device".parse().expect("a name");
        for kind in Kind::ALL {
            let files = c_project(kind, &name);
            let text = |path: &str| {
                let file = files.iter().find(|file| file.path == path);
                &file.unwrap_or_else(|| panic!("{kind}: no {path}")).text
            };
            assert!(text(&format!("src/{kind}.c")).contains("taceva_status"));
            assert!(text("include/taceva/plugin.h").contains("TACEVA_MAGIC"));
            let (manifest, exported) = (text("plugin.toml"), text("src/plugin.c"));
            let of_kind = format!("kind = \"{kind}\"");
            for part in [of_kind.as_str(), "key = \"my-device\""] {
                assert!(manifest.contains(part), "{manifest}");
                assert!(exported.contains(&literal(part)), "{exported}");
            }
            for file in &files {
                for left in ["@name@", "@crate@", "kind@", "@KIND@", "@table@", "@use@"] {
                    assert!(!file.text.contains(left), "{}: {left}", file.path);
                }
            }
        }
    }
}
