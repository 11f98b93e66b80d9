//! Options that were renamed are read by their former names too, with a note.

mod support;

use support::Bench;

#[test]
fn a_former_name_is_read_and_its_present_one_is_named_once() {
    let bench = Bench::new();
    bench.lab();
    for (words, note) in [
        (
            "import lab --map map.toml --to data",
            "--to is called --out now",
        ),
        (
            "cache prune --cache kept --keep 0 --dry-run",
            "--dry-run is called --explain now",
        ),
        (
            "plugin headers inc",
            "plugin headers DIR is called plugin headers --out DIR now",
        ),
    ] {
        let ran = bench.run(words);
        assert_eq!(ran.code, 0, "{words}\n{}", ran.err);
        assert_eq!(ran.err.matches(note).count(), 1, "{words}\n{}", ran.err);
    }
    assert!(bench.path("data/dataset.toml").exists());
    assert!(bench.path("inc").is_dir());
}

#[test]
fn results_are_named_alike_by_every_command() {
    let bench = Bench::new();
    bench.write(
        "t.csv",
        "id,point_id,Fz\n1,a,0.1\n2,b,0.2\n3,c,0.3\n4,d,0.4\n5,e,0.5\n6,f,0.6\n",
    );
    bench.write(
        "p.csv",
        "id,Fz\n1,0.11\n2,0.21\n3,0.32\n4,0.41\n5,0.52\n6,0.61\n",
    );
    bench.ok("score --truth t.csv --pred p.csv --metrics mae --format json --out r.json -q");
    let now = bench.ok("choose --need force --results r.json");
    let former = bench.run("choose --need force --from r.json");
    assert_eq!(former.out, now);
    assert!(former.err.contains("--from is called --results now"));
    let former = bench.run("catalogue site --out pages --with r.json");
    assert_eq!(former.code, 0, "{}", former.err);
    assert!(former.err.contains("--with is called --results now"));
}

#[test]
fn both_names_together_are_refused_and_both_are_said() {
    let bench = Bench::new();
    for (words, names) in [
        ("import lab --map m.toml --to a --out b", ["--to", "--out"]),
        (
            "choose --need force --from a.json --results b.json",
            ["--from", "--results"],
        ),
        (
            "cache prune --keep 0 --dry-run --explain",
            ["--dry-run", "--explain"],
        ),
    ] {
        let ran = bench.run(words);
        assert_eq!(ran.code, 2, "{words}\n{}", ran.err);
        for name in names {
            assert!(ran.err.contains(name), "{words}: {name}\n{}", ran.err);
        }
    }
}
