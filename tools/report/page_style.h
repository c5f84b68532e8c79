#pragma once
// The page's style sheet, without the rules of the drawings (svg.h).

#include <string_view>

namespace talus::tools {

inline constexpr std::string_view kPageStyle = R"css(
:root{--page:#fff;--ink:#1a1a1a;--muted:#595959;--line:#ccc;--tint:#f4f6f8;--link:#005a8c}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:68rem;background:var(--page);color:var(--ink);
  font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.5rem 0 1rem}
h2{font-size:1.25rem;margin:2.5rem 0 .75rem;padding-top:.75rem;border-top:1px solid var(--line)}
h3{font-size:1rem;margin:1.25rem 0 .25rem}
p{margin:.4rem 0 .8rem;max-width:48rem}
.lead{font-size:1.1rem}
.alert{border-left:4px solid #b34700;padding:.5rem .75rem;background:var(--tint)}
.muted{color:var(--muted)}
nav{font-size:.95rem}
nav a{margin-right:1rem;white-space:nowrap}
a{color:var(--link)}
sub{line-height:0}
.wide{overflow-x:auto;margin:1rem 0}
.wide>svg{display:block;width:100%;min-width:560px;max-width:52rem;height:auto}
.key{list-style:none;display:flex;flex-wrap:wrap;gap:.2rem 1.4rem;padding:0;margin:.8rem 0}
.key svg{width:24px;height:14px;vertical-align:-2px;margin-right:.5rem}
.slopes{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,17rem),1fr));gap:1.25rem;
  margin:1rem 0}
.slopes.pair{max-width:42rem}
figure{margin:0;display:flex;flex-direction:column;justify-content:flex-end;break-inside:avoid}
figure svg{width:100%;height:auto;display:block}
figcaption{font-size:.88rem;line-height:1.35;margin-top:.3rem;min-height:4.1em}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums}
caption{text-align:left;font-weight:600;padding:.25rem 0}
th,td{padding:.28rem .4rem;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}
th{font-weight:600;vertical-align:bottom}
thead th{border-bottom:2px solid var(--ink)}
thead tr:not(:last-child) th{border-bottom:1px solid var(--line);text-align:center}
.whole{white-space:nowrap}
.words{text-align:left}
.start{border-left:1px solid var(--line)}
td.main{font-weight:700}
details{margin:.4rem 0}
summary{cursor:pointer}
pre{overflow-x:auto;background:var(--tint);padding:.75rem;font-size:.82rem;line-height:1.4}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;font-size:.92rem}
dt{color:var(--muted)}
dd{margin:0;overflow-wrap:anywhere}
@media screen and (prefers-color-scheme:dark){
:root{--page:#16181b;--ink:#ececec;--muted:#b0b4b8;--line:#3a3f44;--tint:#22262a;--link:#7cc4f0}}
@media (max-width:36rem){dl{grid-template-columns:1fr}dd{margin-bottom:.4rem}}
@media print{
body{max-width:none;padding:0;font-size:10.5pt}
nav{display:none}
h2,h3{break-after:avoid}
table{font-size:7.5pt}
th,td{padding:.15rem .25rem}
tr,.wide{break-inside:avoid}
.wide{overflow:visible}
.slopes{grid-template-columns:repeat(3,1fr)}
.slopes.pair{grid-template-columns:repeat(2,1fr)}
pre{white-space:pre-wrap}}
)css";

}  // namespace talus::tools
