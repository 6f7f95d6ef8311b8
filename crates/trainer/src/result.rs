//! What came of a round, in eight letters that a learner reads out or sends, and many of them in a table.
//!
//! A code has 40 bits: the generator's version (4), kind (3), level (2), seed (20), questions right at the first
//! answer (3), and a CRC over these 32 (8), which notices every mistyped letter and nearly every pair of letters
//! that changed places. Of a set the kind is 7, the seed what tells its text apart, and level and questions make one
//! number of 5 bits. It is no secret, and proves nothing: whoever wants to make one up can.

use crate::practice::{Kind, LETTERS, QUESTIONS, Round, Seed, VERSION, letter_number};
use crate::set::MOST;

/// The number that stands for a set where a round has its kind.
const SET: u32 = 7;

/// What was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    Round(Round),
    /// The set whose text has this [`seed`](crate::set::seed).
    Set(Seed),
}

/// What came of a round or a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RoundResult {
    pub about: About,
    /// How many questions were right at the first answer.
    pub right: usize,
}

/// Why letters are no code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoCode {
    /// There are not eight of them, or one is none that codes have.
    Letters,
    /// One of them is another than it should be.
    Mistyped,
    /// A newer page made it.
    Newer,
}

impl NoCode {
    /// In a sentence.
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Letters => "A code has eight letters or digits, without I, L, O and U.",
            Self::Mistyped => "One of the letters is another one: compare them once more.",
            Self::Newer => "It is of a newer version of the page: reload this one.",
        }
    }
}

impl RoundResult {
    /// The eight letters, in two groups: `0C3A-K7QM`.
    pub fn code(&self) -> String {
        let (kind, level, seed, right) = match self.about {
            About::Round(Round { kind, level, seed }) => {
                (kind as u32, u32::from(level & 3), seed, self.right.min(QUESTIONS) as u32)
            }
            About::Set(seed) => {
                let right = self.right.min(MOST) as u32;
                (SET, right >> 3, seed, right & 7)
            }
        };
        let word = u32::from(VERSION) << 28 | kind << 25 | level << 23 | seed.number() << 3 | right;
        let bits = u64::from(word) << 8 | u64::from(check(word));
        let letter = |at: u32| char::from(LETTERS[(bits >> (5 * at) & 31) as usize]);
        (0..8).rev().flat_map(|at| [Some(letter(at)), (at == 4).then_some('-')]).flatten().collect()
    }

    /// The result that a code tells; spaces, hyphens and small letters do not matter.
    pub fn of(code: &str) -> Result<Self, NoCode> {
        let letters = code.chars().filter(|c| !c.is_whitespace() && !matches!(c, '-' | '–' | '.'));
        let numbers: Option<Vec<u32>> = letters.map(letter_number).collect();
        let numbers = numbers.filter(|numbers| numbers.len() == 8).ok_or(NoCode::Letters)?;
        let bits = numbers.into_iter().fold(0_u64, |bits, number| bits << 5 | u64::from(number));
        let word = (bits >> 8) as u32;
        if check(word) != bits as u8 {
            return Err(NoCode::Mistyped);
        }
        let (version, kind, level) = ((word >> 28) as u8, (word >> 25 & 7) as usize, (word >> 23 & 3) as u8);
        let seed = Seed::new(u64::from(word >> 3));
        let right = (word & 7) as usize;
        if version > VERSION {
            return Err(NoCode::Newer);
        }
        if version == VERSION && kind == SET as usize {
            return Ok(Self { about: About::Set(seed), right: usize::from(level) << 3 | right });
        }
        match Kind::ALL.get(kind) {
            Some(kind) if version == VERSION && level > 0 && right <= QUESTIONS => {
                Ok(Self { about: About::Round(Round { kind: *kind, level, seed }), right })
            }
            _ => Err(NoCode::Mistyped),
        }
    }
}

/// CRC-8 with polynomial 07h and start FFh, high bit first.
fn check(word: u32) -> u8 {
    let bit = |crc: u8, _| if crc & 0x80 == 0 { crc << 1 } else { crc << 1 ^ 0x07 };
    word.to_be_bytes().iter().fold(0xFF, |crc, byte| (0..8).fold(crc ^ byte, bit))
}

/// A line of what was handed in: who, and the code or why it is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    pub name: String,
    pub code: String,
    pub result: Result<RoundResult, NoCode>,
}

/// Reads many results: a line each, the code at its end or beginning and a name beside it, with a tab, comma,
/// semicolon, colon or space between. What begins with `#` is a remark.
pub fn lines(text: &str) -> Vec<Line> {
    text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')).map(line).collect()
}

fn line(text: &str) -> Line {
    let parts = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':');
    let words: Vec<&str> = text.split(parts).filter(|word| !word.is_empty()).collect();
    let name = |rest: &[&str]| rest.join(" ");
    // A code in two words counts as well.
    let tries = [(1, true), (2, true), (1, false), (2, false)];
    let mut first = None;
    for (count, last) in tries {
        if words.len() < count {
            continue;
        }
        let (code, rest) = match last {
            true => (&words[words.len() - count..], &words[..words.len() - count]),
            false => (&words[..count], &words[count..]),
        };
        let result = RoundResult::of(&code.concat());
        let found = Line { name: name(rest), code: code.join(" "), result };
        match result {
            Ok(_) => return found,
            Err(NoCode::Letters) => first = first.or(Some(found)),
            // Eight letters that are wrong say more than words that are no code at all.
            Err(_) => {
                if first.as_ref().is_none_or(|line| line.result == Err(NoCode::Letters)) {
                    first = Some(found);
                }
            }
        }
    }
    first.unwrap_or(Line { name: String::new(), code: text.to_owned(), result: Err(NoCode::Letters) })
}

/// The table as CSV: name, code, kind, level, seed, right, of.
pub fn csv(lines: &[Line]) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut text = "name,code,kind,level,seed,right,of,problem\n".to_owned();
    for Line { name, code, result } in lines {
        text += &match result {
            Ok(RoundResult { about: About::Round(round), right }) => format!(
                "{},{code},{},{},{},{right},{QUESTIONS},\n",
                quoted(name),
                round.kind.key(),
                round.level,
                round.seed
            ),
            // How many there were, only the set's text says.
            Ok(RoundResult { about: About::Set(seed), right }) => {
                format!("{},{code},set,,{seed},{right},,\n", quoted(name))
            }
            Err(problem) => {
                format!("{},{},,,,,,{}\n", quoted(name), quoted(code), quoted(problem.sentence()))
            }
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(kind: Kind, level: u8, seed: u64, right: usize) -> RoundResult {
        RoundResult { about: About::Round(Round { kind, level, seed: Seed::new(seed) }), right }
    }

    #[test]
    fn codes_lead_back() {
        for kind in Kind::ALL {
            for level in 1..=3 {
                for right in 0..=QUESTIONS {
                    let one = result(kind, level, 77_777 * right as u64 + 3, right);
                    let code = one.code();
                    assert_eq!(code.len(), 9);
                    assert_eq!(RoundResult::of(&code), Ok(one));
                    assert_eq!(RoundResult::of(&code.to_lowercase().replace('-', " ")), Ok(one));
                }
            }
        }
    }

    #[test]
    fn sets_have_codes_too() {
        for right in 0..=MOST {
            let one = RoundResult { about: About::Set(Seed::new(99_999 * right as u64 + 7)), right };
            assert_eq!(RoundResult::of(&one.code()), Ok(one));
        }
    }

    #[test]
    fn typos_are_noticed() {
        let code = result(Kind::Build, 2, 123_456, 4).code().replace('-', "");
        let letters: Vec<char> = code.chars().collect();
        for at in 0..8 {
            for other in
                LETTERS.iter().map(|letter| char::from(*letter)).filter(|other| *other != letters[at])
            {
                let mut typed = letters.clone();
                typed[at] = other;
                assert!(RoundResult::of(&typed.iter().collect::<String>()).is_err(), "{at} {other}");
            }
        }
        for at in 0..7 {
            let mut typed = letters.clone();
            typed.swap(at, at + 1);
            assert!(typed == letters || RoundResult::of(&typed.iter().collect::<String>()).is_err(), "{at}");
        }
        for none in ["", "1234567", "123456789", "UUUUUUUU", "hello"] {
            assert_eq!(RoundResult::of(none), Err(NoCode::Letters), "{none}");
        }
    }

    #[test]
    fn many_make_a_table() {
        let (one, other) = (result(Kind::Decode, 1, 5, 5), result(Kind::Find, 3, 9, 2));
        let wrong = one.code().replace('-', "").replacen(|c: char| c.is_ascii_digit(), "Z", 1);
        let text = format!(
            "# group A\nAnna Weber\t{}\n\n{}, Ben\nClara; {}\nDavid {wrong}\nno code at all\n",
            one.code(),
            other.code(),
            other.code().replace('-', " "),
        );
        let table = lines(&text);
        let names: Vec<&str> = table.iter().map(|line| line.name.as_str()).collect();
        assert_eq!(names[..3], ["Anna Weber", "Ben", "Clara"]);
        assert_eq!(table[0].result, Ok(one));
        assert_eq!(table[1].result, Ok(other));
        assert_eq!(table[2].result, Ok(other));
        assert_eq!((table[3].name.as_str(), table[3].result), ("David", Err(NoCode::Mistyped)));
        assert_eq!(table[4].result, Err(NoCode::Letters));
        assert!(csv(&table).starts_with("name,code,"));
        assert_eq!(csv(&table).lines().count(), 6);
    }
}
