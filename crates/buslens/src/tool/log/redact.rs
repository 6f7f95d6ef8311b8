//! A log to pass on: with what is nobody's business replaced by something else of the same length.
//!
//! What stands for the same thing is replaced by the same thing everywhere, in the bytes and in the words
//! beside them. Checks that were right are right again; those that were wrong are wrong in the same way, so that
//! what happened to a telegram can still be found. All else stays as it is, byte for byte. A capture is
//! written anew, of its telegrams only.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::{Entry, Format, Log, Role, Source, Way};
use crate::capture::{About, Writer};
use crate::field::{self, Direction, Field, Role as Means, Span, Value};
use crate::frame::{Verdict, modbus_ascii, modbus_rtu, modbus_tcp, profibus_fdl};
use crate::tool::checksums::CHECKSUMS;
use crate::tool::decode::Report;
use crate::walk::Algorithm;

/// What is to be hidden.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Hidden {
    /// Units and stations, in telegrams and behind words such as "unit" or "slave".
    pub units: bool,
    /// Addresses of networks and network cards, in the words of the log.
    pub addresses: bool,
    /// Texts in telegrams, and where they stand in the words of the log.
    pub texts: bool,
    /// Names that a person gives: of plants, customers, computers.
    pub names: Vec<String>,
}

/// A log that can be passed on.
#[derive(Clone, Debug, Default)]
pub struct Redacted {
    pub file: Vec<u8>,
    /// It is a capture, as what was read was one.
    pub is_capture: bool,
    /// What was replaced, and by what: not to be passed on.
    pub replaced: Vec<Replaced>,
    /// Telegrams that stay as they are, since their bytes were not found in the text.
    pub left: usize,
    /// Bytes of no telegram, which stay as they are.
    pub unread: usize,
}

/// Something that was replaced.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Replaced {
    pub kind: Kind,
    pub from: String,
    pub to: String,
    /// How often.
    pub times: usize,
}

/// What is hidden.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub enum Kind {
    Unit,
    Address,
    Text,
    Name,
}

impl Kind {
    pub const fn label(self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::Address => "network address",
            Self::Text => "text",
            Self::Name => "name",
        }
    }
}

impl Replaced {
    /// A line of a list of them: what it is, what it was, what it is now, how often.
    pub fn line(&self) -> String {
        format!("{}\t{}\t{}\t{}\n", self.kind.label(), self.from, self.to, self.times)
    }
}

/// So many telegrams are read at a time.
const AT_ONCE: usize = 1000;
/// What is read of the file at a time.
const PART: usize = 1 << 20;

impl Log {
    /// The log without what is to be hidden.
    ///
    /// ```
    /// use buslens::tool::log::{Hidden, Log, Reading};
    /// use buslens::tool::Options;
    ///
    /// let text = b"10.0.0.7 unit 5: 05 03 00 C8 00 03 85 B1\n".as_slice();
    /// let log = Log::read(text, &Reading::default(), Options::default()).unwrap();
    /// let hidden = Hidden { units: true, addresses: true, ..Hidden::default() };
    /// let redacted = log.redacted(&text, text.len() as u64, &hidden);
    /// assert_eq!(redacted.file, b"11.1.1.1 unit 1: 01 03 00 C8 00 03 84 35\n");
    /// ```
    pub fn redacted(&self, source: &dyn Source, size: u64, hidden: &Hidden) -> Redacted {
        let mut desk = Desk::new(hidden);
        let mut redacted = Redacted { is_capture: self.writes_capture(), ..Redacted::default() };
        let mut writer = Writer::default();
        if redacted.is_capture {
            redacted.file = writer.begin();
        }
        // Units of right telegrams are those that there are; damage made the others up.
        for entry in self.entries().iter().filter(|entry| entry.counts() && entry.verdict != Verdict::Wrong) {
            if let (Some(unit), true) = (entry.unit, hidden.units) {
                desk.unit(unit);
            }
        }
        let mut edits: Vec<(Span, Vec<u8>)> = Vec::new();
        // Where telegrams stand, nothing else is looked for.
        let mut taken: Vec<Span> = Vec::new();
        let indices: Vec<usize> = (0..self.entries().len()).collect();
        for part in indices.chunks(AT_ONCE) {
            let report = self.report(source, part);
            for (place, index) in part.iter().enumerate() {
                let entry = &self.entry(*index);
                if entry.role == Role::Discarded {
                    redacted.unread += usize::from(entry.length);
                }
                let Some(telegram) = report.telegrams.get(place) else { continue };
                let bytes = desk.telegram(entry, &report, place);
                if redacted.is_capture {
                    if entry.counts() {
                        redacted.file.extend(self.packet(entry, &bytes, &mut writer));
                    }
                    continue;
                }
                let line = &telegram.line;
                if line.places.len() < line.bytes.len() {
                    redacted.left += usize::from(bytes != line.bytes);
                    continue;
                }
                taken.extend(whole(&line.places));
                for ((old, new), place) in line.bytes.iter().zip(&bytes).zip(&line.places) {
                    if old != new {
                        edits.push((*place, vec![*old, *new]));
                    }
                }
            }
        }
        if !redacted.is_capture {
            let taken = field::in_order(taken, |span| *span);
            redacted.left += self.rewrite(source, size, &mut desk, (edits, &taken), &mut redacted.file);
        }
        redacted.replaced = desk.replaced();
        redacted
    }

    /// Whether what is passed on is a capture: what was read was one, or the text of one.
    fn writes_capture(&self) -> bool {
        match self.input {
            Way::Text(_) | Way::Utf16 { .. } | Way::Stream => false,
            Way::Capture(_) | Way::Packets(_) => true,
        }
    }

    /// A telegram as a packet between ends that are nobody's.
    fn packet(&self, entry: &Entry, bytes: &[u8], writer: &mut Writer) -> Vec<u8> {
        let about = About {
            time: entry.time(),
            from_client: Some(entry.direction == Direction::Request),
            comment: "",
        };
        let end = |last, port| SocketAddr::new(IpAddr::V4(Ipv4Addr::new(192, 0, 2, last)), port);
        match entry.protocol() {
            protocol if protocol.is(&modbus_tcp::PROTOCOL) => {
                writer.tcp(end(1, 49_152_u16.saturating_add(entry.port)), end(2, 502), bytes, about)
            }
            protocol if protocol.is(&modbus_rtu::PROTOCOL) => writer.serial("mbrtu", bytes, about),
            _ => writer.serial("data", bytes, about),
        }
    }

    /// Writes the text with bytes of telegrams replaced (`edits`: their places, old and new), and with what its
    /// words give away. Gives how many bytes could not be replaced.
    fn rewrite(
        &self,
        source: &dyn Source,
        size: u64,
        desk: &mut Desk<'_>,
        (edits, taken): (Vec<(Span, Vec<u8>)>, &[Span]),
        file: &mut Vec<u8>,
    ) -> usize {
        let read = |from: u64| self.read_again(source, from, PART);
        let is_text = !matches!(self.format, Format::Stream);
        let mut edits = field::in_order_by(edits, Ord::cmp);
        edits.dedup();
        let mut edits = edits.into_iter().peekable();
        let (mut from, mut left) = (0, 0);
        while from < size.max(self.transcoded.as_ref().map_or(0, |text| text.len() as u64)) {
            let mut part = read(from);
            if part.is_empty() {
                break;
            }
            // Whole lines, so that no word is cut in two; a line that is longer is cut somewhere.
            let last = from + part.len() as u64 >= size;
            if let (true, false, Some(end)) = (is_text, last, part.iter().rposition(|c| *c == b'\n')) {
                part.truncate(end + 1);
            }
            let base = from as usize;
            let mut changes: Vec<(Span, Vec<u8>)> = Vec::new();
            while let Some((place, bytes)) = edits.next_if(|(place, _)| place.from < base + part.len()) {
                let telegram = taken.get(taken.partition_point(|span| span.to <= place.from));
                let telegram = telegram.map_or(Span::default(), |span| {
                    Span::new(span.from.saturating_sub(base), span.to.saturating_sub(base))
                });
                let lower = telegram.of(&part).iter().any(|c| matches!(c, b'a'..=b'f'))
                    && !telegram.of(&part).iter().any(|c| matches!(c, b'A'..=b'F'));
                let place = Span::new(place.from.saturating_sub(base), place.to.saturating_sub(base));
                let written = if is_text {
                    written(place.of(&part), bytes[0], bytes[1], lower)
                } else {
                    Some(vec![bytes[1]])
                };
                match written {
                    Some(written) => changes.push((place, written)),
                    None => left += 1,
                }
            }
            if is_text {
                let first = taken.partition_point(|span| span.to <= base);
                let near = taken[first..].iter().take_while(|span| span.from < base + part.len());
                let near = near.map(|span| Span::new(span.from.saturating_sub(base), span.to - base));
                changes.extend(desk.words(&part, &near.collect::<Vec<_>>()));
            }
            let changes = field::in_order_by(changes, Ord::cmp);
            let mut at = 0;
            for (place, written) in changes {
                if place.from >= at && place.to <= part.len() {
                    file.extend_from_slice(&part[at..place.from]);
                    file.extend(written);
                    at = place.to;
                }
            }
            file.extend_from_slice(&part[at..]);
            from += part.len() as u64;
        }
        left
    }
}

/// The stretches that the places of a telegram cover, line by line.
fn whole(places: &[Span]) -> Vec<Span> {
    /// Between bytes stand marks; more is another part of the line.
    const NEAR: usize = 8;
    let mut spans: Vec<Span> = Vec::new();
    for place in places {
        match spans.last_mut() {
            Some(last) if place.from >= last.from && place.from <= last.to + NEAR => {
                last.to = last.to.max(place.to);
            }
            _ => spans.push(*place),
        }
    }
    spans
}

/// A byte as it is written at a place, with the same number of digits where they are enough; `lower` says how
/// hex is written there.
fn written(text: &[u8], old: u8, new: u8, lower: bool) -> Option<Vec<u8>> {
    let text = str::from_utf8(text).ok()?;
    // "0x05", "\x05", "05h".
    let bare = text.trim_start_matches("0x").trim_start_matches("0X").trim_start_matches(r"\x");
    let bare = if bare.len() > 2 { bare.trim_end_matches(['h', 'H']) } else { bare };
    if bare.len() < text.len() && !bare.is_empty() {
        let (before, after) = text.split_once(bare)?;
        let digits = written(bare.as_bytes(), old, new, lower)?;
        return Some([before.as_bytes(), &digits, after.as_bytes()].concat());
    }
    let hex = |width: usize| if lower { format!("{new:0width$x}") } else { format!("{new:0width$X}") };
    let is = |radix| u8::from_str_radix(text, radix) == Ok(old);
    let width = text.len();
    let written = match () {
        () if is(16) && width <= 2 => hex(width),
        () if is(10) => format!("{new:0$}", if text.starts_with('0') || width == 3 { width } else { 0 }),
        () if is(8) => format!("{new:0width$o}"),
        // A digit of Modbus ASCII each: "30 33" is 03.
        () if width >= 4 => {
            let digits: Vec<&str> = text.split(|c: char| !c.is_ascii_hexdigit()).collect();
            let [high, low] = digits[..] else { return None };
            let digit = |text: &str| {
                let code = u8::from_str_radix(text, 16).ok()?;
                char::from(code).to_digit(16)
            };
            if digit(high)? << 4 | digit(low)? != u32::from(old) {
                return None;
            }
            let [first, second] = [new >> 4, new & 15].map(|digit| {
                let digit = char::from_digit(digit.into(), 16).unwrap_or('0').to_ascii_uppercase();
                format!("{:02X}", digit as u32)
            });
            let between = text.get(high.len()..width - low.len())?;
            format!("{first}{between}{second}")
        }
        // The character that the byte is.
        () if text.chars().eq([char::from(old)]) && new.is_ascii_graphic() => char::from(new).to_string(),
        () => return None,
    };
    Some(written.into_bytes())
}

/// What was replaced by what, and how often.
struct Desk<'a> {
    hidden: &'a Hidden,
    units: BTreeMap<u8, (u8, usize)>,
    texts: HashMap<Vec<u8>, Vec<u8>>,
    /// By what is in front of a group of an address, and the group.
    groups: HashMap<(String, String), String>,
    cards: HashMap<String, String>,
    /// How many damaged telegrams were looked into.
    explained: usize,
    /// In the order in which they were met.
    met: Vec<Replaced>,
    places: HashMap<(Kind, String), usize>,
}

impl<'a> Desk<'a> {
    fn new(hidden: &'a Hidden) -> Self {
        Self {
            hidden,
            units: BTreeMap::new(),
            texts: HashMap::new(),
            groups: HashMap::new(),
            cards: HashMap::new(),
            explained: 0,
            met: Vec::new(),
            places: HashMap::new(),
        }
    }

    fn note(&mut self, kind: Kind, from: &str, to: &str) {
        let fresh = self.met.len();
        let at = *self.places.entry((kind, from.to_owned())).or_insert(fresh);
        if at == fresh {
            self.met.push(Replaced { kind, from: from.to_owned(), to: to.to_owned(), times: 0 });
        }
        self.met[at].times += 1;
    }

    fn replaced(mut self) -> Vec<Replaced> {
        self.met.retain(|it| it.from != it.to);
        for (unit, (new, times)) in std::mem::take(&mut self.units) {
            if times > 0 && unit != new {
                self.met.push(Replaced {
                    kind: Kind::Unit,
                    from: unit.to_string(),
                    to: new.to_string(),
                    times,
                });
            }
        }
        field::in_order(self.met, |it| it.kind)
    }

    /// Another unit with as many digits, always the same one for the same; nobody's addresses stay.
    fn unit(&mut self, unit: u8) -> u8 {
        let class = match unit {
            1..=9 => 1..=9,
            10..=99 => 10..=99,
            // Above are reserved addresses, and those that mean none.
            100..=247 => 100..=247,
            _ => return unit,
        };
        if let Some((new, _)) = self.units.get(&unit) {
            return *new;
        }
        let taken: HashSet<u8> = self.units.values().map(|(new, _)| *new).collect();
        let free = || class.clone().filter(|new| !taken.contains(new));
        let new = free().find(|new| *new != unit).or_else(|| free().next()).unwrap_or(unit);
        self.units.insert(unit, (new, 0));
        new
    }

    /// The same of an address that perhaps nobody has: where a telegram is damaged, its bits are turned as they
    /// were before.
    fn unit_of(&mut self, unit: u8, damaged: bool) -> u8 {
        if self.units.contains_key(&unit) || !damaged {
            let new = self.unit(unit);
            if let Some((_, times)) = self.units.get_mut(&unit) {
                *times += 1;
            }
            return new;
        }
        let nearest = self.units.iter().min_by_key(|(known, _)| (*known ^ unit).count_ones());
        nearest.map_or(unit, |(known, (new, _))| new ^ known ^ unit)
    }

    /// The bytes of a telegram without what is to be hidden.
    fn telegram(&mut self, entry: &Entry, report: &Report, place: usize) -> Vec<u8> {
        let old = &report.telegrams[place].line.bytes;
        let mut bytes = old.to_vec();
        if entry.role == Role::Discarded {
            return bytes;
        }
        let protocol = entry.protocol();
        let damaged = entry.verdict == Verdict::Wrong;
        let fdl = protocol.is(&profibus_fdl::PROTOCOL);
        let wants_detail = self.hidden.units && fdl
            || self.hidden.texts && longest_text(old) >= SHORTEST_TEXT
            || fdl && !self.hidden.names.is_empty();
        let detail = wants_detail.then(|| report.detail(place)).flatten();
        let leaves = detail.as_ref().map_or(Vec::new(), |detail| field::leaves(&detail.fields));
        let units = if fdl {
            let is_address =
                |leaf: &&&Field| leaf.spec.role == Means::Unit && !leaf.spec.key.contains("group");
            leaves.iter().filter(is_address).map(|leaf| leaf.span).filter(|span| span.len() == 1).collect()
        } else if protocol.is(&modbus_tcp::PROTOCOL) {
            vec![Span::new(6, 7)]
        } else if protocol.key == "modbus-pdu" || protocol.key.starts_with("profibus") {
            Vec::new()
        } else {
            vec![Span::new(0, 1)]
        };
        for span in units.into_iter().filter(|_| self.hidden.units) {
            if let Some(byte) = bytes.get_mut(span.from) {
                let extension = if fdl { *byte & 0x80 } else { 0 };
                *byte = self.unit_of(*byte ^ extension, damaged) | extension;
            }
        }
        if let Some(detail) = detail.as_ref().filter(|_| self.hidden.texts) {
            let mut texts = Vec::new();
            let fields = detail.fields.iter().chain(detail.device.blocks.iter().map(|block| &block.field));
            fields.for_each(|field| texts_of(field, &mut texts));
            texts.extend(detail.registers.into_iter().flat_map(|span| runs(old, span)));
            for span in texts {
                self.hide_text(Kind::Text, span, old, &mut bytes);
            }
        }
        // An empty name would be found for ever.
        for name in self.hidden.names.iter().filter(|name| !name.is_empty()) {
            let name = name.as_bytes();
            let mut from = 0;
            while let Some(at) = find(&old[from..], name) {
                let span = Span::new(from + at, from + at + name.len());
                self.hide_text(Kind::Name, span, old, &mut bytes);
                from = span.to;
            }
        }
        if bytes != *old {
            repair(protocol.key, &leaves, old, &mut bytes);
            if damaged && protocol.is(&modbus_rtu::PROTOCOL) && self.explained < MOST_EXPLAINED {
                self.explained += 1;
                keep_damage(report, place, old, &mut bytes);
            }
        }
        bytes
    }

    fn hide_text(&mut self, kind: Kind, span: Span, old: &[u8], bytes: &mut [u8]) {
        let text = span.of(old);
        // What stands behind a text to fill its room is none of it.
        let length = text.iter().rposition(|c| !matches!(c, 0 | b' ')).map_or(0, |last| last + 1);
        let text = &text[..length];
        if text.is_empty() {
            return;
        }
        let new = self.text(text);
        self.note(kind, &String::from_utf8_lossy(text), &String::from_utf8_lossy(&new));
        bytes[span.from..span.from + length].copy_from_slice(&new);
    }

    /// Another text of the same length, with letters for letters and digits for digits.
    fn text(&mut self, text: &[u8]) -> Vec<u8> {
        if let Some(known) = self.texts.get(text) {
            return known.clone();
        }
        /// Where hardly any letter is there, others cannot all differ.
        const TRIES: u32 = 100;
        let mut state = self.texts.len() as u32;
        let mut new = Vec::new();
        for _ in 0..TRIES {
            let mut next = |count: u8| {
                // Any sequence will do; that it is always the same one makes the outcome so.
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 16) as u8 % count
            };
            let other = |c: &u8| match *c {
                b'0'..=b'9' => b'0' + next(10),
                b'A'..=b'Z' => b'A' + next(26),
                b'a'..=b'z' | 0x80.. => b'a' + next(26),
                other => other,
            };
            new = text.iter().map(other).collect();
            if new != text && !self.texts.values().any(|known| *known == new) {
                break;
            }
        }
        self.texts.insert(text.to_vec(), new.clone());
        new
    }

    /// What the words of some lines give away, but for the places of telegrams.
    fn words(&mut self, part: &[u8], taken: &[Span]) -> Vec<(Span, Vec<u8>)> {
        let mut changes = Vec::new();
        let free = |span: Span| {
            let at = taken.partition_point(|other| other.to <= span.from);
            taken.get(at).is_none_or(|other| other.from >= span.to)
        };
        if self.hidden.addresses {
            for span in words(part, is_of_address) {
                let Ok(word) = str::from_utf8(span.of(part)) else { continue };
                if let Some((length, new)) = self.address(word).filter(|_| free(span)) {
                    let span = Span::new(span.from, span.from + length);
                    self.note(Kind::Address, &word[..length], &new);
                    changes.push((span, new.into_bytes()));
                }
            }
        }
        if self.hidden.units && !self.units.is_empty() {
            for (span, unit) in named_units(part) {
                if self.units.contains_key(&unit) && free(span) {
                    let new = self.unit_of(unit, false);
                    changes.extend(written_number(span.of(part), unit, new).map(|text| (span, text)));
                }
            }
        }
        let mut names: Vec<(Kind, Vec<u8>)> =
            self.hidden.names.iter().map(|name| (Kind::Name, name.clone().into_bytes())).collect();
        if self.hidden.texts {
            /// Shorter ones are parts of any word; and nobody waits for more of them.
            const SHORTEST: usize = 4;
            const MOST: usize = 200;
            let texts = self.texts.keys().filter(|text| text.len() >= SHORTEST);
            let texts = field::in_order(texts, |text| *text);
            names.extend(texts.into_iter().take(MOST).map(|text| (Kind::Text, text.clone())));
        }
        for (kind, name) in names.into_iter().filter(|(_, name)| !name.is_empty()) {
            let mut from = 0;
            while let Some(at) = find_word(&part[from..], &name) {
                let span = Span::new(from + at, from + at + name.len());
                from = span.to;
                if free(span) {
                    let found = span.of(part).to_vec();
                    // In whatever case it stands, it becomes the same.
                    let plain = self.text(&name);
                    let cased = found.iter().zip(&plain).map(|(found, new)| match found {
                        b'A'..=b'Z' => new.to_ascii_uppercase(),
                        b'a'..=b'z' => new.to_ascii_lowercase(),
                        _ => *new,
                    });
                    let cased: Vec<u8> = cased.collect();
                    self.note(kind, &String::from_utf8_lossy(&name), &String::from_utf8_lossy(&plain));
                    changes.push((span, cased));
                }
            }
        }
        let mut changes = field::in_order_by(changes, Ord::cmp);
        changes.dedup_by(|later, earlier| later.0.from < earlier.0.to);
        changes
    }

    /// An address of IP or of a network card that a word begins with: how long it is, and another one.
    fn address(&mut self, word: &str) -> Option<(usize, String)> {
        let word = word.trim_end_matches([':', '.', '-']);
        // "10.0.0.5:502" is an address with its port.
        let host = word.split_once(':').map_or(word, |(host, _)| host);
        if let Ok(address) = host.parse::<Ipv4Addr>() {
            if address.is_loopback() || address.is_unspecified() || address.is_broadcast() {
                return None;
            }
            return Some((host.len(), self.regrouped(host, '.', 10)));
        }
        let groups: Vec<&str> = word.split([':', '-']).collect();
        let is_card = groups.len() == 6
            && groups.iter().all(|group| group.len() == 2)
            && (word.matches(':').count() == 5 || word.matches('-').count() == 5)
            && groups.iter().all(|group| u8::from_str_radix(group, 16).is_ok());
        if is_card {
            return Some((word.len(), self.card(word)));
        }
        let address = word.parse::<std::net::Ipv6Addr>().ok()?;
        (!address.is_loopback() && !address.is_unspecified())
            .then(|| (word.len(), self.regrouped(word, ':', 16)))
    }

    /// Each group of an address replaced by one of as many digits; the same behind the same groups.
    fn regrouped(&mut self, address: &str, mark: char, radix: u32) -> String {
        let mut before = String::new();
        let mut new = Vec::new();
        for group in address.split(mark) {
            new.push(self.group(&before, group, radix));
            before += group;
            before.push(mark);
        }
        new.join(&mark.to_string())
    }

    fn group(&mut self, before: &str, group: &str, radix: u32) -> String {
        let key = (before.to_owned(), group.to_owned());
        if let Some(known) = self.groups.get(&key) {
            return known.clone();
        }
        let digits = group.len() as u32;
        if digits == 0 {
            return String::new();
        }
        let most = if radix == 10 { 255 } else { radix.pow(digits) - 1 };
        let least = if digits == 1 { 1 } else { radix.pow(digits - 1) };
        let all = (least..=most.min(radix.pow(digits) - 1)).chain((digits == 1).then_some(0));
        let all = all.map(|n| if radix == 10 { n.to_string() } else { format!("{n:x}") });
        let taken: HashSet<&String> =
            self.groups.iter().filter(|((other, _), _)| other == before).map(|(_, new)| new).collect();
        // Most groups of the second pass are new again: the first free one is near.
        let free: Vec<String> = all.filter(|new| !taken.contains(new)).take(2).collect();
        let new = free.iter().find(|new| *new != group).or(free.first()).cloned();
        let new = new.unwrap_or_else(|| group.to_owned());
        self.groups.insert(key, new.clone());
        new
    }

    /// Another address of a network card: one that its owner may choose.
    fn card(&mut self, card: &str) -> String {
        let lower = card.to_ascii_lowercase();
        let number = self.cards.len() + 1;
        let new = self.cards.entry(lower).or_insert_with(|| {
            format!("02{0}00{0}00{0}00{0}{1:02x}{0}{2:02x}", &card[2..3], number >> 8 & 255, number & 255)
        });
        if card.chars().any(|c| c.is_ascii_uppercase()) { new.to_ascii_uppercase() } else { new.clone() }
    }
}

/// Makes the check of a telegram right again; one that was wrong is wrong in the same way.
fn repair(protocol: &str, leaves: &[&Field], old: &[u8], bytes: &mut [u8]) {
    let of_kind = |kind: &str| CHECKSUMS.iter().find(|it| it.algorithm.kind == kind).map(|it| it.algorithm);
    let end = |width: usize| Span::new(old.len().saturating_sub(width), old.len());
    let check = match protocol {
        key if key == modbus_rtu::PROTOCOL.key => of_kind("crc-16/modbus").map(|it| (it, end(2))),
        key if key == modbus_ascii::PROTOCOL.key => of_kind("lrc").map(|it| (it, end(1))),
        _ => None,
    };
    let (algorithm, found, covered): (&Algorithm, Span, Span) = match check {
        Some((algorithm, found)) => (algorithm, found, Span::new(0, found.from)),
        None => {
            let told = leaves.iter().find_map(|leaf| match leaf.value {
                Value::Check(check) => Some((of_kind(check.kind)?, leaf.span, check.covered)),
                _ => None,
            });
            let Some(told) = told else { return };
            told
        }
    };
    let width = algorithm.width;
    if found.len() != width || found.to > bytes.len() {
        return;
    }
    let number = |bytes: &[u8]| bytes.iter().fold(0_u64, |all, byte| all << 8 | u64::from(*byte));
    let before = algorithm.wire(covered.of(old));
    let now = algorithm.wire(covered.of(bytes));
    let was = number(found.of(old));
    // What a CRC differs by follows from the change alone; so does the difference of a sum.
    let new = if width == 2 { now ^ before ^ was } else { now.wrapping_add(was).wrapping_sub(before) };
    bytes[found.from..found.to].copy_from_slice(&new.to_be_bytes()[8 - width..]);
}

/// So many damaged telegrams are looked into; it takes a while.
const MOST_EXPLAINED: usize = 1000;

/// Where bytes were lost or added on the way, the CRC is still that of the telegram as it was sent: of the same
/// unit as it is called now.
fn keep_damage(report: &Report, place: usize, old: &[u8], bytes: &mut [u8]) {
    let Some(found) = report.explanations(place).into_iter().next() else { return };
    let mut sent = found.hypothesis.bytes;
    let ends = (sent.len().checked_sub(2), old.len().checked_sub(2));
    let (Some(covered), Some(end)) = ends else { return };
    let same = old.first() == sent.first() && old[end..] == sent[covered..];
    if !same || covered == 0 || bytes[1..end] != old[1..end] {
        return;
    }
    sent[0] = bytes[0];
    let crc = crate::walk::CRC_16_MODBUS.wire(&sent[..covered]).to_be_bytes();
    bytes[end..].copy_from_slice(&crc[6..]);
}

/// Fewer characters in a row are found in any numbers.
const SHORTEST_TEXT: usize = 6;

fn is_character(byte: u8) -> bool {
    (0x20..0x7F).contains(&byte)
}

/// How many characters are in a row at most.
fn longest_text(bytes: &[u8]) -> usize {
    bytes.split(|byte| !is_character(*byte)).map(<[u8]>::len).max().unwrap_or(0)
}

/// Runs of characters within registers that are words or numbers of something.
fn runs(bytes: &[u8], within: Span) -> Vec<Span> {
    let mut runs = Vec::new();
    let mut from = within.from;
    for part in within.of(bytes).split(|byte| !is_character(*byte)) {
        let letters = part.iter().filter(|byte| byte.is_ascii_alphanumeric()).count();
        if part.len() >= SHORTEST_TEXT && letters * 3 >= part.len() * 2 {
            runs.push(Span::new(from, from + part.len()));
        }
        from += part.len() + 1;
    }
    runs
}

/// The places of the texts of a field and of those within it.
fn texts_of(field: &Field, texts: &mut Vec<Span>) {
    if matches!(field.value, Value::Text(_)) && !texts.contains(&field.span) {
        texts.push(field.span);
    }
    field.children.iter().for_each(|child| texts_of(child, texts));
}

fn find(whole: &[u8], part: &[u8]) -> Option<usize> {
    memchr::memmem::find(whole, part)
}

/// A word in whatever case.
fn find_word(whole: &[u8], part: &[u8]) -> Option<usize> {
    let first = part.first()?;
    let mut from = 0;
    while let Some(at) =
        memchr::memchr2(first.to_ascii_lowercase(), first.to_ascii_uppercase(), whole.get(from..)?)
    {
        let at = from + at;
        if whole.get(at..at + part.len())?.eq_ignore_ascii_case(part) {
            return Some(at);
        }
        from = at + 1;
    }
    None
}

fn is_of_address(byte: u8) -> bool {
    byte.is_ascii_hexdigit() || matches!(byte, b'.' | b':' | b'-')
}

/// The runs of such characters that begin with no mark and stand beside no other letter.
fn words(part: &[u8], is: fn(u8) -> bool) -> Vec<Span> {
    let mut words = Vec::new();
    let mut at = 0;
    while at < part.len() {
        let length = part[at..].iter().position(|byte| !is(*byte)).unwrap_or(part.len() - at);
        let beside = |at: Option<usize>| {
            at.and_then(|at| part.get(at)).is_some_and(|c| c.is_ascii_alphanumeric() || *c == b'_')
        };
        if length >= 3 && !beside(at.checked_sub(1)) && !beside(Some(at + length)) {
            words.push(Span::new(at, at + length));
        }
        at += length + 1;
    }
    words
}

/// Numbers behind words that say that they are units.
fn named_units(part: &[u8]) -> Vec<(Span, u8)> {
    const WORDS: [&[u8]; 10] = [
        b"unit", b"slave", b"station", b"node", b"addr", b"address", b"device", b"unitid", b"slaveid",
        b"server",
    ];
    let mut found = Vec::new();
    let mut at = 0;
    while at < part.len() {
        if !part[at].is_ascii_alphabetic() {
            at += 1;
            continue;
        }
        let length = part[at..].iter().position(|c| !c.is_ascii_alphabetic()).unwrap_or(part.len() - at);
        let word = part[at..at + length].to_ascii_lowercase();
        at += length;
        if !WORDS.contains(&word.as_slice()) {
            continue;
        }
        // "unit id = 5", "slave_id: 0x05", "address 5".
        let rest = &part[at..];
        let id = rest.iter().take(4).position(|c| c.is_ascii_digit()).is_none() && rest.len() > 3;
        let skip = if id && rest[1..3].eq_ignore_ascii_case(b"id") { 3 } else { 0 };
        let marks = rest[skip..].iter().take_while(|c| b" :=#[(\"'\t".contains(c)).count();
        let from = at + skip + marks;
        let digits = part[from..].iter().take_while(|c| c.is_ascii_alphanumeric()).count();
        let Ok(text) = str::from_utf8(&part[from..from + digits]) else { continue };
        let unit = match text.strip_prefix("0x").or(text.strip_prefix("0X")) {
            Some(hex) => u8::from_str_radix(hex, 16),
            None => text.parse(),
        };
        if let Ok(unit) = unit {
            found.push((Span::new(from, from + digits), unit));
            at = from + digits;
        }
    }
    found
}

/// A number of a unit as it is written there.
fn written_number(text: &[u8], old: u8, new: u8) -> Option<Vec<u8>> {
    if text.starts_with(b"0x") || text.starts_with(b"0X") {
        return written(text, old, new, text[2..].iter().any(u8::is_ascii_lowercase));
    }
    let width = if text.starts_with(b"0") { text.len() } else { 0 };
    Some(format!("{new:0width$}").into_bytes())
}
