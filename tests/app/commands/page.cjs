// A session with a page of `weft report` in Chromium, by what a reader sees: prints as JSON what page.py checks.
//
//     node page.cjs CHROMIUM PAGE
"use strict";
const { chromium } = require("playwright-core");
const [, , executablePath, file] = process.argv;
const address = require("url").pathToFileURL(file).href;

async function session() {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const context = await browser.newContext({ viewport: { width: 1600, height: 900 }, permissions: ["clipboard-read", "clipboard-write"], reducedMotion: "reduce" });
  const page = await context.newPage(), seen = { errors: [], requests: [], accessibility: [] };
  page.on("console", (message) => { if (message.type() === "error") seen.errors.push(message.text()); });
  page.on("pageerror", (error) => seen.errors.push(String(error)));
  page.on("request", (request) => { if (!request.url().startsWith("data:")) seen.requests.push(request.url()); });
  const selected = () => page.locator("aside h2").innerText(), texts = (css) => page.locator(css).allInnerTexts();
  const steps = async () => (await page.locator(".column").evaluateAll((all) => all.map((each) => each.dataset.step))).map((step) => step.split(" ").map(Number));
  const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
  await page.goto(address);
  seen.selectedFirst = await selected();
  seen.columns = await steps();
  seen.inView = await page.locator(".matrix").evaluate((matrix) => [...matrix.querySelectorAll(".column")].filter((head) => head.getBoundingClientRect().right <= matrix.getBoundingClientRect().right + 1).length);

  // fold and open
  const ibl = page.locator('button.group[title="ibl"]');
  seen.foldedAtFirst = await ibl.getAttribute("aria-expanded");
  await ibl.click();
  seen.opened = await steps();
  await ibl.click();
  seen.foldedAgain = await steps();

  // search, the address, arrows, the tree
  await page.keyboard.press("/");
  await page.keyboard.type("find edges");
  seen.found = await texts("[role=option]");
  await page.keyboard.press("Enter");
  seen.searched = [await selected(), new URL(page.url()).hash];
  await page.locator(".matrix").focus();
  await page.keyboard.press("ArrowLeft");
  seen.left = await selected();
  await page.keyboard.press("ArrowDown");
  seen.down = await selected();
  await page.locator(".tree summary", { hasText: /^sky\b/ }).click();
  await page.locator(".tree button", { hasText: "skybox" }).click();
  seen.tree = await selected();
  const second = await context.newPage();
  await second.goto(address + "#post.display.composite");
  seen.byAddress = await second.locator("aside h2").innerText();
  await second.close();

  // copy, links for an editor
  await page.locator("header .copy").click();
  seen.command = await clipboard();
  await page.locator("aside .copy").last().click();
  seen.copiedFile = await clipboard();
  await page.locator(".editor input").fill("editor://{file}#{line}");
  await page.keyboard.press("Tab");
  seen.links = await page.locator("aside a").evaluateAll((all) => all.map((each) => each.getAttribute("href")));

  // what differs, and the wipe: left of its edge is the picture before, right of it the one after
  await page.locator("#tabDifference").click();
  seen.difference = await texts("[role=tabpanel] pre");
  const box = await page.locator(".wipe img").first().boundingBox(), range = page.locator(".wipe input");
  const part = (from) => page.screenshot({ clip: { x: Math.round(box.x + from * box.width), y: Math.round(box.y), width: Math.round(box.width / 4), height: Math.round(Math.min(box.height, 840 - box.y)) } });
  const shots = {};
  for (const share of ["0", "50", "100"]) { await range.fill(share); shots[share] = [await part(0.05), await part(0.7)]; }
  const same = (a, b) => a.equals(b);
  seen.wipe = [same(shots[50][0], shots[100][0]), same(shots[50][1], shots[0][1]), same(shots[0][0], shots[100][0])];
  seen.marksAfter = await texts(".column b");
  await page.locator("header button", { hasText: "before" }).click();
  seen.marksBefore = await page.locator(".column:has(b)").evaluateAll((all) => all.map((each) => [each.querySelector("b").textContent.trim(), Number(each.dataset.step.split(" ")[0])]));
  seen.columnsBefore = await steps();

  // the loupe
  await page.goto(address + "#post.fxaa.smooth");
  await page.locator("header button", { hasText: "after" }).click();
  await page.locator("aside img").first().hover({ position: { x: 300, y: 40 } });
  seen.texel = await page.locator(".loupe code").innerText();

  // themes, print, accessibility
  seen.grounds = [];
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    seen.grounds.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number)));
    await page.addScriptTag({ path: require.resolve("axe-core/axe.min.js") });
    for (const tab of await texts("[role=tab]")) {
      await page.locator("#tab" + tab).click();
      const found = await page.evaluate(() => globalThis.axe.run());
      seen.accessibility.push(...found.violations.map((each) => `${colorScheme}, ${tab}: ${each.id}: ${each.nodes[0].html.slice(0, 200)}`));
    }
  }
  await page.emulateMedia({ media: "print" });
  seen.printed = await page.evaluate(() => [document.documentElement.scrollHeight > innerHeight, document.querySelector(".search").getBoundingClientRect().height]);
  await browser.close();
  return seen;
}
session().then((seen) => console.log(JSON.stringify(seen)), (error) => { console.error(error); process.exit(1); });
