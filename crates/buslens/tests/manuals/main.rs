//! Every fact of the three manuals that somebody with a telegram could need, one row each, and what Buslens
//! says of it.
//!
//! A row of `keb_f5_modbus.tsv`, `keb_f5_profibus.tsv` and `memograph_rsg45.tsv` has the section, the fact,
//! how it is read, the telegrams (parted by ` / `, the last one counts), the sentence, the problems, and
//! what must be said besides, in notes or fields (parted by ` | `). `BLESS=1` rewrites sentence and
//! problems; read that before you commit it.
//!
//! How: `channel` for a parameter channel by itself, `settings`, `display` for what the display shows,
//! `search` for words typed into Build, `printed` with the bytes as the manual misprints them.

mod builds;
mod facts;
mod words;

use std::path::PathBuf;

use buslens::device::Profile;
use buslens::tool::PROFILES;

/// Facts and builds are counted together: a fact that cannot be asked for is half a fact.
#[test]
fn every_fact_of_the_manuals_is_right() {
    let (facts, builds) = (facts::rows(), builds::rows());
    let wrong: Vec<String> =
        facts.iter().filter_map(facts::wrong).chain(builds.iter().filter_map(builds::wrong)).collect();
    if std::env::var_os("BLESS").is_some() {
        facts::bless(&facts);
        builds::bless(&builds);
    }
    let all = facts.len() + builds.len();
    println!("{} of {all} facts", all - wrong.len());
    assert!(wrong.is_empty(), "{}\n{} of {all} facts", wrong.join("\n"), all - wrong.len());
    assert_eq!((facts.len(), builds.len()), (882, 84), "no fact is lost");
}

/// What is typed into Build in the manuals' words, and in a person's.
#[test]
fn what_a_person_means_comes_first() {
    let rows = words::rows();
    let wrong: Vec<String> = rows.iter().filter_map(words::wrong).collect();
    if std::env::var_os("BLESS").is_some() {
        words::bless(&rows);
    }
    println!("{} of {} words and sentences", rows.len() - wrong.len(), rows.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn table(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/manuals").join(format!("{name}.tsv"))
}

fn lines(name: &str) -> Vec<Vec<String>> {
    let path = table(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines().map(|line| line.split('\t').map(str::to_owned).collect()).collect()
}

fn write_lines(name: &str, lines: impl Iterator<Item = Vec<String>>) {
    let text: String = lines.map(|line| line.join("\t") + "\n").collect();
    std::fs::write(table(name), text).unwrap();
}

fn profile(key: &str) -> &'static Profile {
    PROFILES.iter().copied().find(|profile| profile.key == key).expect(key)
}
