<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="uk_UA">
<context>
    <name>Clauses</name>
    <message>
        <source>Set the head to {}; Enter when it reads so, or type the reading</source>
        <translation>Встановіть головку на {}; натисніть Enter, коли відлік такий, або введіть відлік</translation>
    </message>
    <message>
        <source>You read {}, the setting was {}: type it again to keep it, or set the head right and press Enter</source>
        <translation>Ваш відлік {}, а слід було встановити {}: введіть його ще раз, щоб залишити, або поправте головку й натисніть Enter</translation>
    </message>
    <message>
        <source>The voltage is {} V off at {} and would fit {}: a wrong {}? Read again and type what you read; Enter keeps it</source>
        <translation>Напруга відхиляється на {} V при {} і відповідала б {}: помилка в цифрі ({})? Зніміть відлік ще раз і введіть його; Enter залишає як є</translation>
    </message>
    <message>
        <source>The voltage is {} V off at {}, which no single wrong digit explains. Read again and type what you read; Enter keeps it</source>
        <translation>Напруга відхиляється на {} V при {}, чого не пояснює жодна одна хибна цифра. Зніміть відлік ще раз і введіть його; Enter залишає як є</translation>
    </message>
    <message>
        <source>{} is no angle; type degrees, minutes and seconds, such as 12 34 56, or 12.5</source>
        <translation>{} — не кут; введіть градуси, мінути й секунди, наприклад 12 34 56, або 12,5</translation>
    </message>
    <message>
        <source>{} has a fraction before its last number; type it without</source>
        <translation>{}: дріб стоїть не в останньому числі; введіть без нього</translation>
    </message>
    <message>
        <source>{} has 60 minutes or seconds, or more; type it with fewer than 60</source>
        <translation>{}: мінут або секунд 60 чи більше; введіть менше ніж 60</translation>
    </message>
    <message>
        <source>degree</source>
        <translation>градуси</translation>
    </message>
    <message>
        <source>minute</source>
        <translation>мінути</translation>
    </message>
    <message>
        <source>the request to seat the unit in {} was answered {}</source>
        <translation>на прохання встановити прилад у положення {} відповіли {}</translation>
    </message>
    <message>
        <source>the request to seat the unit in {} was not answered</source>
        <translation>на прохання встановити прилад у положення {} не відповіли</translation>
    </message>
    <message>
        <source>the request to set the head to {} was answered {}</source>
        <translation>на прохання встановити головку на {} відповіли {}</translation>
    </message>
    <message>
        <source>seat it and resume the run</source>
        <translation>встановіть його і продовжте прогін</translation>
    </message>
    <message>
        <source>set it and resume the run</source>
        <translation>встановіть її і продовжте прогін</translation>
    </message>
    <message>
        <source>the programme was carried out</source>
        <translation>програму виконано</translation>
    </message>
    <message>
        <source>the operator stopped the run</source>
        <translation>оператор зупинив прогін</translation>
    </message>
    <message>
        <source>{} complete point kept in {}</source>
        <translation>{} повну точку збережено в {}</translation>
    </message>
    <message>
        <source>{} complete points kept in {}</source>
        <translation>повних точок збережено: {}, у {}</translation>
    </message>
    <message>
        <source>tumble resume goes on</source>
        <translation>прогін можна продовжити на екрані «Записи»</translation>
    </message>
    <message>
        <source>a fault of the program: {}</source>
        <translation>помилка програми: {}</translation>
    </message>
    <message>
        <source>report it, then resume the run</source>
        <translation>повідомте про неї, потім продовжте прогін</translation>
    </message>
    <message>
        <source>point {} ({} at {} deg): {} of {} samples are overloads or no numbers</source>
        <translation>точка {} ({} при {}°): {} з {} відліків — перевантаження або не числа</translation>
    </message>
    <message>
        <source>the point will be set aside</source>
        <translation>точку буде відкладено</translation>
    </message>
    <message>
        <source>point {} ({} at {} deg): the output had not settled after {}</source>
        <translation>точка {} ({} при {}°): вихід не встановився за {}</translation>
    </message>
    <message>
        <source>the point is kept and marked</source>
        <translation>точку залишено й позначено</translation>
    </message>
    <message>
        <source>dividing head: {}</source>
        <translation>ділильна головка: {}</translation>
    </message>
    <message>
        <source>simulated head: {}</source>
        <translation>імітована головка: {}</translation>
    </message>
    <message>
        <source>voltmeter: {}</source>
        <translation>вольтметр: {}</translation>
    </message>
    <message>
        <source>stand: {}</source>
        <translation>стенд: {}</translation>
    </message>
    <message>
        <source>is not connected</source>
        <translation>не під’єднано</translation>
    </message>
    <message>
        <source>connect it first</source>
        <translation>спершу під’єднайте</translation>
    </message>
    <message>
        <source>has lost its reference</source>
        <translation>втратила початок відліку</translation>
    </message>
    <message>
        <source>look at its power supply, then resume the run</source>
        <translation>перевірте її живлення, потім продовжте прогін</translation>
    </message>
    <message>
        <source>cannot be brought to rest</source>
        <translation>не вдається зупинити</translation>
    </message>
    <message>
        <source>switch it off and look at it</source>
        <translation>вимкніть її та огляньте</translation>
    </message>
    <message>
        <source>its standstill could not be read back</source>
        <translation>нерухомість не підтверджено відліком</translation>
    </message>
    <message>
        <source>look at it before you touch it</source>
        <translation>огляньте її, перш ніж торкатися</translation>
    </message>
    <message>
        <source>was told to find its reference, and has not found it in time</source>
        <translation>мала знайти початок відліку і вчасно не знайшла</translation>
    </message>
    <message>
        <source>look at its home sensor and at its drive, then resume the run</source>
        <translation>перевірте давач нуля та привід, потім продовжте прогін</translation>
    </message>
    <message>
        <source>was to stand at {} deg for a dwell, and is at {} deg after it</source>
        <translation>мала стояти на {}° під час виміру, а після нього стоїть на {}°</translation>
    </message>
    <message>
        <source>look for what turns it, then resume the run</source>
        <translation>з’ясуйте, що її повертає, потім продовжте прогін</translation>
    </message>
    <message>
        <source>still moves at {} deg when it should long have stood at {} deg</source>
        <translation>досі рухається на {}°, хоча давно мала стояти на {}°</translation>
    </message>
    <message>
        <source>stands at {} deg when it should long have stood at {} deg</source>
        <translation>стоїть на {}°, хоча давно мала стояти на {}°</translation>
    </message>
    <message>
        <source>look for what blocks it, check its drive and speed, then resume the run</source>
        <translation>з’ясуйте, що її блокує, перевірте привід і швидкість, потім продовжте прогін</translation>
    </message>
    <message>
        <source>does not answer</source>
        <translation>не відповідає</translation>
    </message>
    <message>
        <source>check its cable, then resume the run</source>
        <translation>перевірте кабель, потім продовжте прогін</translation>
    </message>
    <message>
        <source>nothing was measured</source>
        <translation>нічого не виміряно</translation>
    </message>
    <message>
        <source>the recording failed: {}</source>
        <translation>запис не вдався: {}</translation>
    </message>
    <message>
        <source>then resume the run</source>
        <translation>потім продовжте прогін</translation>
    </message>
    <message>
        <source>stand {}: the calibration of the head was due on {}</source>
        <translation>стенд {}: строк повірки головки минув {}</translation>
    </message>
    <message>
        <source>stand {}: the calibration of the daq was due on {}</source>
        <translation>стенд {}: строк повірки вольтметра минув {}</translation>
    </message>
    <message>
        <source>have it done</source>
        <translation>здайте на повірку</translation>
    </message>
    <message>
        <source>What the declared model leaves was traced to {}</source>
        <translation>Залишок заявленої моделі пояснено ефектами: {}</translation>
    </message>
    <message>
        <source>What that does to the parameters is said below the results</source>
        <translation>Вплив на параметри наведено нижче результатів</translation>
    </message>
    <message>
        <source>No effect of the catalogue explains what depends on {}: {}</source>
        <translation>Жоден ефект каталогу не пояснює залежності від «{}»: {}</translation>
    </message>
    <message>
        <source>Read or set wrong by a round amount: {}</source>
        <translation>Помилково встановлено або зчитано на кругле значення: {}</translation>
    </message>
    <message>
        <source>Nothing was traced: {}</source>
        <translation>Причин не шукали: {}</translation>
    </message>
    <message>
        <source>{} rows are too few</source>
        <translation>{} рядків замало</translation>
    </message>
    <message>
        <source>at least {} are needed</source>
        <translation>потрібно принаймні {}</translation>
    </message>
    <message>
        <source>With that taken into account the poses agree with the model (lack of fit: p {})</source>
        <translation>З урахуванням цього положення узгоджуються з моделлю (неадекватність: p {})</translation>
    </message>
    <message>
        <source>With that taken into account the poses still disagree with the model (lack of fit: p {})</source>
        <translation>І з урахуванням цього положення не узгоджуються з моделлю (неадекватність: p {})</translation>
    </message>
    <message>
        <source>Neither an effect of the catalogue nor any other structure was found, yet the poses disagree with the declared model by more than the repeats explain (lack of fit: p {})</source>
        <translation>Не знайдено ні ефекту каталогу, ні іншої структури, проте положення розходяться із заявленою моделлю більше, ніж пояснюють повтори (неадекватність: p {})</translation>
    </message>
    <message>
        <source>Nothing is left that the scatter of the data does not explain: neither an effect of the catalogue nor any other structure stands out of it</source>
        <translation>Не залишилося нічого, чого не пояснює розсіяння даних: ні ефект каталогу, ні інша структура з нього не виступає</translation>
    </message>
    <message>
        <source>residual, r.m.s.</source>
        <translation>залишок, СКВ</translation>
    </message>
    <message>
        <source>held-out error, r.m.s.</source>
        <translation>похибка на відкладених даних, СКВ</translation>
    </message>
    <message>
        <source>lack of fit, p</source>
        <translation>неадекватність, p</translation>
    </message>
    <message>
        <source>not tested</source>
        <translation>не перевіряли</translation>
    </message>
    <message>
        <source>none</source>
        <translation>немає</translation>
    </message>
    <message>
        <source>cannot be told</source>
        <translation>визначити неможливо</translation>
    </message>
    <message>
        <source>{}, given alpha0 = {}</source>
        <translation>{}, за умови alpha0 = {}</translation>
    </message>
    <message>
        <source>given alpha0 = {}</source>
        <translation>за умови alpha0 = {}</translation>
    </message>
    <message>
        <source>rests on {}</source>
        <translation>спирається на {}</translation>
    </message>
    <message>
        <source>unit</source>
        <translation>прилад</translation>
    </message>
    <message>
        <source>stand</source>
        <translation>стенд</translation>
    </message>
    <message>
        <source>DAQ</source>
        <translation>вольтметр</translation>
    </message>
    <message>
        <source>inside</source>
        <translation>у межах</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>поза межами</translation>
    </message>
    <message>
        <source>not decided</source>
        <translation>не вирішено</translation>
    </message>
    <message>
        <source>not decided: no value</source>
        <translation>не вирішено: немає значення</translation>
    </message>
    <message>
        <source>inside, but the interval reaches out</source>
        <translation>у межах, але інтервал виходить за них</translation>
    </message>
    <message>
        <source>outside, but the interval reaches in</source>
        <translation>поза межами, але інтервал заходить у них</translation>
    </message>
    <message>
        <source>This data cannot tell {}</source>
        <translation>За цими даними неможливо визначити: {}</translation>
    </message>
    <message>
        <source>the table of results says why</source>
        <translation>причини — в таблиці результатів</translation>
    </message>
    <message>
        <source>its 95% interval is unbounded: {}</source>
        <translation>його інтервал 95 % необмежений: {}</translation>
    </message>
    <message>
        <source>no row has gravity along {}, or nothing parts it from another parameter</source>
        <translation>у жодному рядку немає тяжіння вздовж {}, або ніщо не відділяє його від іншого параметра</translation>
    </message>
    <message>
        <source>no row has gravity along Ox and Oy at once</source>
        <translation>у жодному рядку немає тяжіння вздовж Ox і Oy водночас</translation>
    </message>
    <message>
        <source>the rows do not part it from the other parameters</source>
        <translation>рядки не відділяють його від інших параметрів</translation>
    </message>
    <message>
        <source>its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy is not large enough</source>
        <translation>його інтервал 95 % сягає 45°: тут його від ky і kz відділяє лише kxy, а kxy недостатньо великий</translation>
    </message>
    <message>
        <source>its 95% interval reaches 45 deg: only kxy parts it from ky and kz here, and kxy cannot be told</source>
        <translation>його інтервал 95 % сягає 45°: тут його від ky і kz відділяє лише kxy, а kxy визначити неможливо</translation>
    </message>
    <message>
        <source>told through the curvature kxy alone, which an undeclared second-order term imitates</source>
        <translation>визначено лише через кривину kxy, яку імітує незаявлений член другого порядку</translation>
    </message>
    <message>
        <source>{} rest on {} alone: {}</source>
        <translation>{} спираються лише на {}: {}</translation>
    </message>
    <message>
        <source>{} rests on {} alone: {}</source>
        <translation>{} спирається лише на {}: {}</translation>
    </message>
    <message>
        <source>a sweep in {} would settle it</source>
        <translation>питання розв’язало б обертання в положенні {}</translation>
    </message>
    <message>
        <source>The recording is incomplete: the result rests on the rows before it was cut off</source>
        <translation>Запис неповний: результат спирається на рядки до обриву</translation>
    </message>
    <message>
        <source>The program that computed this had changes that are in no commit</source>
        <translation>Програма, що це обчислила, мала зміни, яких немає в жодному коміті</translation>
    </message>
    <message>
        <source>The declared model does not describe the data: the poses disagree with it by more than the repeats explain (p {})</source>
        <translation>Заявлена модель не описує даних: положення розходяться з нею більше, ніж пояснюють повтори (p {})</translation>
    </message>
    <message>
        <source>The uncertainties rest on that disagreement</source>
        <translation>Невизначеності спираються на це розходження</translation>
    </message>
    <message>
        <source>{}: the declared model does not describe the poses (lack of fit, p = {})</source>
        <translation>{}: заявлена модель не описує положень (неадекватність, p = {})</translation>
    </message>
    <message>
        <source>uncertainties rest on that disagreement</source>
        <translation>невизначеності спираються на це розходження</translation>
    </message>
    <message>
        <source>{}: {} then differs from {} by {} in -2 ln L</source>
        <translation>{}: тоді {} відрізняється від {} на {} у −2 ln L</translation>
    </message>
    <message>
        <source>{}: {} then differs from {} by {} in -2 ln L, if {} is the true one</source>
        <translation>{}: тоді {} відрізняється від {} на {} у −2 ln L, якщо істинний — {}</translation>
    </message>
    <message>
        <source>at least {}</source>
        <translation>щонайменше {}</translation>
    </message>
    <message>
        <source>only together with {}</source>
        <translation>лише разом із {}</translation>
    </message>
    <message>
        <source>run it {} times</source>
        <translation>виконайте його {} рази</translation>
    </message>
    <message>
        <source>{} visits the same poses again, at the temperature as it is now</source>
        <translation>{} повторює ті самі положення за теперішньої температури</translation>
    </message>
    <message>
        <source>{} visits every pose from both sides</source>
        <translation>{} підходить до кожного положення з обох боків</translation>
    </message>
    <message>
        <source>{} turns Oy over and leaves Ox and the head as they are</source>
        <translation>{} перевертає Oy, а Ox і головку залишає як є</translation>
    </message>
    <message>
        <source>{} turns Ox by 90° on the head, so that errors of the head fall on other values of ax</source>
        <translation>{} повертає Ox на 90° на головці, тож похибки головки припадають на інші значення ax</translation>
    </message>
    <message>
        <source>{} puts Oz in the place of Oy</source>
        <translation>{} ставить Oz на місце Oy</translation>
    </message>
    <message>
        <source>{} puts Oz in the place of Oy, turned over</source>
        <translation>{} ставить Oz на місце Oy, перевернувши</translation>
    </message>
    <message>
        <source>{} takes ax away and leaves ay and az</source>
        <translation>{} усуває ax і залишає ay та az</translation>
    </message>
    <message>
        <source>{} takes the angles in no order, so that neither time nor the dwell before goes with them</source>
        <translation>{} бере кути безладно, тож із ними не пов’язані ні час, ні попередній вимір</translation>
    </message>
    <message>
        <source>{} visits the same poses again, two hours later</source>
        <translation>{} повторює ті самі положення через дві години</translation>
    </message>
    <message>
        <source>{} visits the same poses with the unit 10 K warmer</source>
        <translation>{} повторює ті самі положення з приладом, теплішим на 10 K</translation>
    </message>
    <message>
        <source>{} cannot be compared: {}</source>
        <translation>{} порівняти неможливо: {}</translation>
    </message>
    <message>
        <source>{} changed by {}, standard uncertainty {}: significant (p = {})</source>
        <translation>{} змінився на {}, стандартна невизначеність {}: суттєво (p = {})</translation>
    </message>
    <message>
        <source>{} changed by {}, standard uncertainty {}: not significant (p = {})</source>
        <translation>{} змінився на {}, стандартна невизначеність {}: несуттєво (p = {})</translation>
    </message>
    <message>
        <source>{} changed by {}, standard uncertainty {}: both records come from one raw file, so this is what the analysis changed</source>
        <translation>{} змінився на {}, стандартна невизначеність {}: обидва записи з одного файлу даних, тож це змінив аналіз</translation>
    </message>
    <message>
        <source>{} did not change: both records come from one raw file</source>
        <translation>{} не змінився: обидва записи з одного файлу даних</translation>
    </message>
    <message>
        <source>Raw file {}: intact</source>
        <translation>Файл даних {}: цілий</translation>
    </message>
    <message>
        <source>Raw file {}: changed</source>
        <translation>Файл даних {}: змінений</translation>
    </message>
    <message>
        <source>Raw file {}: missing</source>
        <translation>Файлу даних {} немає</translation>
    </message>
    <message>
        <source>Altered in the store: {}</source>
        <translation>Змінено у сховищі: {}</translation>
    </message>
    <message>
        <source>The record is intact</source>
        <translation>Запис цілий</translation>
    </message>
    <message>
        <source>Nothing was fitted again</source>
        <translation>Нічого не перераховували</translation>
    </message>
    <message>
        <source>Fitted again, these do not come back: {}</source>
        <translation>Після перерахунку не відтворюються: {}</translation>
    </message>
</context>
<context>
    <name>CutOffView</name>
    <message>
        <source>unit</source>
        <translation>прилад</translation>
    </message>
    <message>
        <source>programme</source>
        <translation>програма</translation>
    </message>
    <message>
        <source>points</source>
        <translation>точок</translation>
    </message>
    <message>
        <source>ended</source>
        <translation>чим закінчилося</translation>
    </message>
    <message>
        <source>recording</source>
        <translation>файл даних</translation>
    </message>
    <message>
        <source>Go on with it</source>
        <translation>Продовжити його</translation>
    </message>
    <message>
        <source>broke off</source>
        <translation>обірвався</translation>
    </message>
</context>
<context>
    <name>Dialog</name>
    <message>
        <source>Close  [Esc]</source>
        <translation>Закрити  [Esc]</translation>
    </message>
</context>
<context>
    <name>InstrumentTable</name>
    <message>
        <source>Driver</source>
        <translation>Драйвер</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Адреса</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Модель</translation>
    </message>
    <message>
        <source>Serial number</source>
        <translation>Заводський номер</translation>
    </message>
    <message>
        <source>Firmware</source>
        <translation>Прошивка</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>Свідоцтво</translation>
    </message>
    <message>
        <source>Calibration due</source>
        <translation>Повірка до</translation>
    </message>
    <message>
        <source>Dividing head</source>
        <translation>Ділильна головка</translation>
    </message>
    <message>
        <source>Voltmeter</source>
        <translation>Вольтметр</translation>
    </message>
    <message>
        <source>✗ {date}: overdue</source>
        <translation>✗ {date}: прострочено</translation>
    </message>
    <message>
        <source>⚠ {date}: soon</source>
        <translation>⚠ {date}: скоро</translation>
    </message>
    <message>
        <source>✓ {date}</source>
        <translation>✓ {date}</translation>
    </message>
</context>
<context>
    <name>Jog</name>
    <message>
        <source>12 34 56, or 12.5</source>
        <translation>12 34 56 або 12,5</translation>
    </message>
    <message>
        <source>Go</source>
        <translation>Перейти</translation>
    </message>
    <message>
        <source>Home</source>
        <translation>До нуля</translation>
    </message>
    <message>
        <source>One step back</source>
        <translation>Крок назад</translation>
    </message>
    <message>
        <source>One step ahead</source>
        <translation>Крок уперед</translation>
    </message>
    <message>
        <source>S&amp;tep</source>
        <translation>К&amp;рок</translation>
    </message>
    <message>
        <source>&amp;Angle</source>
        <translation>Ку&amp;т</translation>
    </message>
</context>
<context>
    <name>LoopView</name>
    <message>
        <source>effect</source>
        <translation>ефект</translation>
    </message>
    <message>
        <source>or</source>
        <translation>або</translation>
    </message>
    <message>
        <source>belongs to</source>
        <translation>належить</translation>
    </message>
    <message>
        <source>coefficients (standard uncertainty)</source>
        <translation>коефіцієнти (стандартна невизначеність)</translation>
    </message>
    <message>
        <source>p</source>
        <translation>p</translation>
    </message>
    <message>
        <source>declared model</source>
        <translation>заявлена модель</translation>
    </message>
    <message>
        <source>with what was found</source>
        <translation>зі знайденим</translation>
    </message>
    <message>
        <source>change</source>
        <translation>зміна</translation>
    </message>
    <message>
        <source>Run the chosen experiment</source>
        <translation>Виконати обраний дослід</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Що знайдено</translation>
    </message>
    <message>
        <source>Before and after</source>
        <translation>До і після</translation>
    </message>
    <message>
        <source>What to measure next</source>
        <translation>Що виміряти далі</translation>
    </message>
    <message>
        <source>{name} cannot be told: {reason}</source>
        <translation>{name} визначити неможливо: {reason}</translation>
    </message>
    <message>
        <source>no programme helps</source>
        <translation>жодна програма не допоможе</translation>
    </message>
</context>
<context>
    <name>MainWindow</name>
    <message>
        <source>Stand</source>
        <translation>Стенд</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Прогін</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Результат</translation>
    </message>
    <message>
        <source>Records</source>
        <translation>Записи</translation>
    </message>
    <message>
        <source>Esc stops nothing: it closes dialogs. STOP is {key}.</source>
        <translation>Esc нічого не зупиняє: ця клавіша закриває вікна. СТОП — {key}.</translation>
    </message>
    <message>
        <source>Not stopped</source>
        <translation>Не зупинено</translation>
    </message>
    <message>
        <source>This run was measured at the stand {its} ({path}); on screen is the stand {shown}. Leave that one, and go on with the run at {its}?</source>
        <translation>Цей прогін виміряно на стенді {its} ({path}); на екрані стенд {shown}. Залишити його й продовжити прогін на стенді {its}?</translation>
    </message>
    <message>
        <source>the simulated stand that is built in</source>
        <translation>вбудований імітований стенд</translation>
    </message>
    <message>
        <source>Another stand</source>
        <translation>Інший стенд</translation>
    </message>
    <message>
        <source>Take the stand {its}, and go on</source>
        <translation>Узяти стенд {its} і продовжити</translation>
    </message>
</context>
<context>
    <name>Menus</name>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Вигляд</translation>
    </message>
    <message>
        <source>Larger text</source>
        <translation>Більший текст</translation>
    </message>
    <message>
        <source>Smaller text</source>
        <translation>Менший текст</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>&amp;Мова</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Довідка</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Клавіші</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Вийти</translation>
    </message>
    <message>
        <source>As the desktop</source>
        <translation>Як у системі</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Світлий</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Темний</translation>
    </message>
    <message>
        <source>The language changes when the window is opened the next time: the stand is at work.</source>
        <translation>Мова зміниться, коли вікно відкриють наступного разу: стенд працює.</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Мова</translation>
    </message>
    <message>
        <source>stop the head, whatever is going on</source>
        <translation>зупинити головку, хоч би що відбувалося</translation>
    </message>
    <message>
        <source>close a dialog; it stops nothing</source>
        <translation>закрити вікно; нічого не зупиняє</translation>
    </message>
    <message>
        <source>start the run</source>
        <translation>почати прогін</translation>
    </message>
    <message>
        <source>pause</source>
        <translation>пауза</translation>
    </message>
    <message>
        <source>go on after a pause</source>
        <translation>продовжити після паузи</translation>
    </message>
    <message>
        <source>yes to the question that is asked</source>
        <translation>«так» на поставлене запитання</translation>
    </message>
    <message>
        <source>the unit sits in the mount</source>
        <translation>прилад установлено</translation>
    </message>
    <message>
        <source>the head reads as set, or as typed</source>
        <translation>відлік головки такий, як задано чи введено</translation>
    </message>
    <message>
        <source>Stand, Run, Result, Records</source>
        <translation>Стенд, Прогін, Результат, Записи</translation>
    </message>
    <message>
        <source>one step with the head</source>
        <translation>один крок головкою</translation>
    </message>
    <message>
        <source>go to the angle that was typed</source>
        <translation>перейти до введеного кута</translation>
    </message>
    <message>
        <source>home the head</source>
        <translation>знайти нуль головки</translation>
    </message>
    <message>
        <source>larger, smaller text</source>
        <translation>більший, менший текст</translation>
    </message>
</context>
<context>
    <name>MountPrompt</name>
    <message>
        <source>It sits there</source>
        <translation>Установлено</translation>
    </message>
    <message>
        <source>Seat the unit as in the picture,
at head angle 0°.</source>
        <translation>Установіть прилад, як на рисунку,
за кута головки 0°.</translation>
    </message>
</context>
<context>
    <name>ProblemDialog</name>
    <message>
        <source>A fault of the program; the head was told to stop.</source>
        <translation>Помилка програми; головці наказано зупинитися.</translation>
    </message>
    <message>
        <source>Something went wrong</source>
        <translation>Щось пішло не так</translation>
    </message>
    <message>
        <source>{error}
The details are in {place}.</source>
        <translation>{error}
Подробиці — у {place}.</translation>
    </message>
</context>
<context>
    <name>ReadingPrompt</name>
    <message>
        <source>12 34 56, or 12.5</source>
        <translation>12 34 56 або 12,5</translation>
    </message>
    <message>
        <source>Reading of the head</source>
        <translation>Відлік головки</translation>
    </message>
    <message>
        <source>Measuring…</source>
        <translation>Вимірювання…</translation>
    </message>
</context>
<context>
    <name>RecordSearch</name>
    <message>
        <source>any</source>
        <translation>усі</translation>
    </message>
    <message>
        <source>inside</source>
        <translation>у межах</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>поза межами</translation>
    </message>
    <message>
        <source>not decided</source>
        <translation>не вирішено</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>без оцінки</translation>
    </message>
    <message>
        <source>&amp;Serial number</source>
        <translation>&amp;Заводський номер</translation>
    </message>
    <message>
        <source>&amp;Programme</source>
        <translation>&amp;Програма</translation>
    </message>
    <message>
        <source>&amp;Verdict</source>
        <translation>Ви&amp;сновок</translation>
    </message>
    <message>
        <source>Fro&amp;m</source>
        <translation>Ві&amp;д</translation>
    </message>
    <message>
        <source>&amp;Until</source>
        <translation>Д&amp;о</translation>
    </message>
</context>
<context>
    <name>RecordsScreen</name>
    <message>
        <source>unit</source>
        <translation>прилад</translation>
    </message>
    <message>
        <source>programme</source>
        <translation>програма</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>виміряно</translation>
    </message>
    <message>
        <source>revision</source>
        <translation>редакція</translation>
    </message>
    <message>
        <source>verdict</source>
        <translation>висновок</translation>
    </message>
    <message>
        <source>record</source>
        <translation>запис</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>Відкр&amp;ити</translation>
    </message>
    <message>
        <source>&amp;Compare two</source>
        <translation>Порів&amp;няти два</translation>
    </message>
    <message>
        <source>Ver&amp;ify</source>
        <translation>Переві&amp;рити</translation>
    </message>
    <message>
        <source>&amp;Analyse again</source>
        <translation>&amp;Аналізувати знову</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>&amp;Експорт…</translation>
    </message>
    <message>
        <source>Trend</source>
        <translation>Тренд</translation>
    </message>
    <message>
        <source>Runs without a record</source>
        <translation>Прогони без запису</translation>
    </message>
    <message>
        <source>Stands</source>
        <translation>Стенди</translation>
    </message>
    <message>
        <source>✓ inside</source>
        <translation>✓ у межах</translation>
    </message>
    <message>
        <source>✗ outside</source>
        <translation>✗ поза межами</translation>
    </message>
    <message>
        <source>? not decided</source>
        <translation>? не вирішено</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>без оцінки</translation>
    </message>
    <message>
        <source>One moment…</source>
        <translation>Хвилинку…</translation>
    </message>
    <message>
        <source>✓ {id} is verified.</source>
        <translation>✓ {id} підтверджено.</translation>
    </message>
    <message>
        <source>✗ {id} does NOT verify:</source>
        <translation>✗ {id} НЕ підтверджено:</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Експорт</translation>
    </message>
    <message>
        <source>{path} is there already. Replace it?</source>
        <translation>{path} уже існує. Замінити?</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>Замінити</translation>
    </message>
    <message>
        <source>Written: {path}</source>
        <translation>Записано: {path}</translation>
    </message>
</context>
<context>
    <name>ResidualFigure</name>
    <message>
        <source>&amp;Model</source>
        <translation>&amp;Модель</translation>
    </message>
    <message>
        <source>A&amp;gainst</source>
        <translation>&amp;Залежно від</translation>
    </message>
    <message>
        <source>declared model</source>
        <translation>заявлена модель</translation>
    </message>
    <message>
        <source>with what was found</source>
        <translation>зі знайденим</translation>
    </message>
    <message>
        <source>head angle within the turn (°)</source>
        <translation>кут головки в межах оберту (°)</translation>
    </message>
    <message>
        <source>time (min)</source>
        <translation>час (хв)</translation>
    </message>
    <message>
        <source>temperature (°C)</source>
        <translation>температура (°C)</translation>
    </message>
    <message>
        <source>realisation</source>
        <translation>реалізація</translation>
    </message>
</context>
<context>
    <name>ResultPlots</name>
    <message>
        <source>residual (µV)</source>
        <translation>залишок (мкВ)</translation>
    </message>
</context>
<context>
    <name>ResultScreen</name>
    <message>
        <source>Open the &amp;report</source>
        <translation>Відкрити &amp;звіт</translation>
    </message>
    <message>
        <source>parameter</source>
        <translation>параметр</translation>
    </message>
    <message>
        <source>value, expanded uncertainty</source>
        <translation>значення, розширена невизначеність</translation>
    </message>
    <message>
        <source>95% interval</source>
        <translation>інтервал 95 %</translation>
    </message>
    <message>
        <source>standard uncertainty</source>
        <translation>стандартна невизначеність</translation>
    </message>
    <message>
        <source>limits</source>
        <translation>межі</translation>
    </message>
    <message>
        <source>verdict</source>
        <translation>висновок</translation>
    </message>
    <message>
        <source>condition</source>
        <translation>умова</translation>
    </message>
    <message>
        <source>There is no result yet: run a programme, or open a record.</source>
        <translation>Результату ще немає: виконайте програму або відкрийте запис.</translation>
    </message>
    <message>
        <source>✓ Inside the limits</source>
        <translation>✓ У межах</translation>
    </message>
    <message>
        <source>✗ Outside the limits: {names}</source>
        <translation>✗ Поза межами: {names}</translation>
    </message>
    <message>
        <source>? Not decided: {names}</source>
        <translation>? Не вирішено: {names}</translation>
    </message>
    <message>
        <source>(with what was found)</source>
        <translation>(з тим, що знайдено)</translation>
    </message>
    <message>
        <source>The programme states no limits</source>
        <translation>Програма не задає меж</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Параметри</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Апроксимація</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>Залишки</translation>
    </message>
    <message>
        <source>Correlations</source>
        <translation>Кореляції</translation>
    </message>
    <message>
        <source>Closed loop</source>
        <translation>Замкнений цикл</translation>
    </message>
    <message>
        <source>{unit} was measured at the stand {its}, and the stand {chosen} is on screen: choose {its} on the screen Stand, then run the experiment</source>
        <translation>{unit} виміряно на стенді {its}, а на екрані стенд {chosen}: виберіть {its} на екрані «Стенд» і тоді почніть експеримент</translation>
    </message>
</context>
<context>
    <name>ResumeOffer</name>
    <message>
        <source>Go on with it</source>
        <translation>Продовжити його</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Не зараз</translation>
    </message>
    <message>
        <source>Not at its end: unit {unit}, programme {programme}, {points} points done at the stand {stand}, begun {when}: {why}.</source>
        <translation>Не завершено: виріб {unit}, програма {programme}, виміряно точок: {points}, стенд {stand}, початок {when}: {why}.</translation>
    </message>
    <message>
        <source>it broke off</source>
        <translation>прогін обірвався</translation>
    </message>
</context>
<context>
    <name>RunForm</name>
    <message>
        <source>type or scan</source>
        <translation>введіть або зчитайте</translation>
    </message>
    <message>
        <source>File…</source>
        <translation>Файл…</translation>
    </message>
    <message>
        <source>There is no serial number yet: type it or scan it</source>
        <translation>Заводського номера ще немає: введіть або зчитайте його</translation>
    </message>
    <message>
        <source>&amp;Serial number</source>
        <translation>&amp;Заводський номер</translation>
    </message>
    <message>
        <source>&amp;Programme</source>
        <translation>&amp;Програма</translation>
    </message>
    <message>
        <source>&amp;Operator</source>
        <translation>&amp;Оператор</translation>
    </message>
    <message>
        <source>Programme</source>
        <translation>Програма</translation>
    </message>
    <message>
        <source>Programmes (*.toml)</source>
        <translation>Програми (*.toml)</translation>
    </message>
    <message>
        <source>{points} points, {mountings} mountings, about {time}</source>
        <translation>точок: {points}, установок: {mountings}, близько {time}</translation>
    </message>
</context>
<context>
    <name>RunLog</name>
    <message>
        <source>Log of the run</source>
        <translation>Журнал прогону</translation>
    </message>
</context>
<context>
    <name>RunPlots</name>
    <message>
        <source>head angle (°)</source>
        <translation>кут головки (°)</translation>
    </message>
    <message>
        <source>output (V)</source>
        <translation>вихід (В)</translation>
    </message>
    <message>
        <source>residual (µV)</source>
        <translation>залишок (мкВ)</translation>
    </message>
    <message>
        <source>time (min)</source>
        <translation>час (хв)</translation>
    </message>
    <message>
        <source>temperature (°C)</source>
        <translation>температура (°C)</translation>
    </message>
    <message>
        <source>time in the dwell (s)</source>
        <translation>час у вимірі (с)</translation>
    </message>
    <message>
        <source>samples (V)</source>
        <translation>відліки (В)</translation>
    </message>
</context>
<context>
    <name>RunScreen</name>
    <message>
        <source>Start</source>
        <translation>Почати</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Пауза</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Далі</translation>
    </message>
    <message>
        <source>{time} ± {error} left</source>
        <translation>ще {time} ± {error}</translation>
    </message>
    <message>
        <source>Fitting…</source>
        <translation>Апроксимація…</translation>
    </message>
    <message>
        <source>Tracing what is left…</source>
        <translation>Пошук причин залишку…</translation>
    </message>
    <message>
        <source>Storing…</source>
        <translation>Збереження…</translation>
    </message>
    <message>
        <source>Writing the report…</source>
        <translation>Складання звіту…</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Готово</translation>
    </message>
    <message>
        <source>Fault: the head&apos;s standstill was not read back</source>
        <translation>Несправність: зупинку головки не підтверджено</translation>
    </message>
    <message>
        <source>Analysing</source>
        <translation>Аналіз</translation>
    </message>
    <message>
        <source>Waits for you, and pauses then</source>
        <translation>Чекає на вас, потім пауза</translation>
    </message>
    <message>
        <source>Pausing…</source>
        <translation>Зупиняється для паузи…</translation>
    </message>
    <message>
        <source>Getting ready</source>
        <translation>Підготовка</translation>
    </message>
</context>
<context>
    <name>Sentences</name>
    <message>
        <source>{instrument}: {model}, serial number {serial}, firmware {firmware}.</source>
        <translation>{instrument}: {model}, заводський номер {serial}, прошивка {firmware}.</translation>
    </message>
    <message>
        <source>Dividing head</source>
        <translation>Ділильна головка</translation>
    </message>
    <message>
        <source>Voltmeter</source>
        <translation>Вольтметр</translation>
    </message>
    <message>
        <source>The unit is to be seated in the mount {mount}.</source>
        <translation>Прилад слід установити в положення {mount}.</translation>
    </message>
    <message>
        <source>The unit sits in the mount {mount}.</source>
        <translation>Прилад установлено в положення {mount}.</translation>
    </message>
    <message>
        <source>Set to {setting}; read: {answer}.</source>
        <translation>Задано {setting}; відлік: {answer}.</translation>
    </message>
    <message>
        <source>as set</source>
        <translation>як задано</translation>
    </message>
    <message>
        <source>The run goes on; {points} points are there already.</source>
        <translation>Прогін триває далі; вже є точок: {points}.</translation>
    </message>
    <message>
        <source>Point {point} was taken again: {now:.6f} V now, {before:.6f} V before.</source>
        <translation>Точку {point} виміряно знову: тепер {now:.6f} V, раніше {before:.6f} V.</translation>
    </message>
    <message>
        <source>The run is over: {message}.</source>
        <translation>Прогін завершено: {message}.</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Готово до роботи</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Вимірювання</translation>
    </message>
    <message>
        <source>Paused; the head stands</source>
        <translation>Пауза; головка стоїть</translation>
    </message>
    <message>
        <source>Waits for you</source>
        <translation>Чекає на вас</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Зупинка</translation>
    </message>
    <message>
        <source>The head stands</source>
        <translation>Головка стоїть</translation>
    </message>
</context>
<context>
    <name>SimulationSettings</name>
    <message>
        <source>The simulated operator seats the unit</source>
        <translation>Прилад установлює імітований оператор</translation>
    </message>
    <message>
        <source>at once</source>
        <translation>миттєво</translation>
    </message>
    <message>
        <source>Simulated stand: time</source>
        <translation>Імітований стенд: час</translation>
    </message>
</context>
<context>
    <name>StandRecords</name>
    <message>
        <source>head angle (°)</source>
        <translation>кут головки (°)</translation>
    </message>
    <message>
        <source>error of the head (″)</source>
        <translation>похибка головки (″)</translation>
    </message>
</context>
<context>
    <name>StandScreen</name>
    <message>
        <source>&amp;Connect</source>
        <translation>П&amp;ід’єднати</translation>
    </message>
    <message>
        <source>&amp;Disconnect</source>
        <translation>&amp;Від’єднати</translation>
    </message>
    <message>
        <source>the simulated stand that is built in</source>
        <translation>вбудований імітований стенд</translation>
    </message>
    <message>
        <source>Stand &amp;file…</source>
        <translation>&amp;Файл стенда…</translation>
    </message>
    <message>
        <source>&amp;Built-in</source>
        <translation>Вбу&amp;дований</translation>
    </message>
    <message>
        <source>Stand file</source>
        <translation>Файл стенда</translation>
    </message>
    <message>
        <source>Stand files (*.toml)</source>
        <translation>Файли стендів (*.toml)</translation>
    </message>
    <message>
        <source>The head does not know its angle: home it first.</source>
        <translation>Головка не знає свого кута: спершу знайдіть нуль.</translation>
    </message>
</context>
<context>
    <name>StandWorker</name>
    <message>
        <source>The stand is at work: stop it, or wait, before you choose another</source>
        <translation>Стенд працює: зупиніть його або зачекайте, перш ніж вибрати інший</translation>
    </message>
    <message>
        <source>The run belongs to the stand {its}, and {chosen} is chosen: choose {its} first</source>
        <translation>Прогін належить стенду {its}, а вибрано {chosen}: спершу виберіть {its}</translation>
    </message>
</context>
<context>
    <name>StopBar</name>
    <message>
        <source>⬢ STOP</source>
        <translation>⬢ СТОП</translation>
    </message>
    <message>
        <source>Stop the head</source>
        <translation>Зупинити головку</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>не під’єднано</translation>
    </message>
    <message>
        <source>angle not known</source>
        <translation>кут невідомий</translation>
    </message>
    <message>
        <source>computing…</source>
        <translation>обчислення…</translation>
    </message>
</context>
<context>
    <name>TrendPlot</name>
    <message>
        <source>time</source>
        <translation>час</translation>
    </message>
    <message>
        <source>units</source>
        <translation>прилади</translation>
    </message>
    <message>
        <source>P&amp;arameter</source>
        <translation>Пара&amp;метр</translation>
    </message>
    <message>
        <source>O&amp;ver</source>
        <translation>За&amp;лежно від</translation>
    </message>
</context>
<context>
    <name>WayOut</name>
    <message>
        <source>Leave</source>
        <translation>Вихід</translation>
    </message>
    <message>
        <source>The stand is at work. Stop it at a standstill, and leave? Complete points are kept.</source>
        <translation>Стенд працює. Зупинити його й вийти? Повні точки збережено.</translation>
    </message>
    <message>
        <source>Stop and leave</source>
        <translation>Зупинити й вийти</translation>
    </message>
</context>
</TS>
